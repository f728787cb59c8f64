#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace wishbone {

/// "no space left on device": the operating system's words for an error number.
std::string system_reason(int error_number);

/// Owner of an open file of the operating system, for writers that must know what has reached the disk. Every failure is a
/// NumericsError with the name of the file and the reason.
class Descriptor {
 public:
  Descriptor() = default;
  /// Makes a new file; it is an error when the name is taken, be it by a link.
  static Descriptor make(const std::string& path);
  /// Opens a file for reading and writing; it is an error when the name is that of a link.
  static Descriptor open(const std::string& path);
  static Descriptor open_or_make(const std::string& path);
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor();

  int get() const { return descriptor_; }
  const std::string& path() const { return path_; }

  void write(std::span<const std::byte> bytes, std::size_t offset);
  void read(std::span<std::byte> bytes, std::size_t offset) const;
  /// Returns once the bytes written are on the disk.
  void sync();
  void close();

 private:
  Descriptor(std::string path, int flags, const char* failure);
  [[noreturn]] void fail(const char* what, int error_number) const;

  std::string path_;
  int descriptor_ = -1;
};

/// Gives a whole and closed file its final name, of which it takes the place of whatever bore it, and puts both on the disk: after
/// a power cut there is either the old file or the new one. @throws NumericsError
void put_in_place(const std::string& from, const std::string& to);

}  // namespace wishbone
