#pragma once

#include <map>
#include <string>
#include <string_view>

#include "core/hdf5_contents.h"
#include "core/isolated_process.h"

namespace wishbone::hdf5 {

/// What is asked of a Server: its contents by an empty request, or the first rows of a dataset.
std::string packed_request(const std::string& path, std::size_t rows);

/// Reads one file with the HDF5 library, for FileReader, in a process of its own: the library crashes, loops, or takes memory
/// without end on files with broken bytes (as of 1.10).
///
/// Sizes are checked before memory is taken: what a dataset claims must fit what it has in the file.
class Server {
 public:
  explicit Server(std::string path) : path_(std::move(path)) {}

  /// Answers with packed(Contents), or with doubles in row-major order. Throws InputError saying what is wrong.
  void answer(std::string_view request, const IsolatedProcess::Send& send);

 private:
  void open();
  Contents contents();
  void send_rows(const std::string& path, std::size_t rows, const IsolatedProcess::Send& send);

  std::string path_;
  Handle file_;
  std::map<std::string, std::string>
      names_;  ///< paths in the bytes of the file, by what the contents call them
};

}  // namespace wishbone::hdf5
