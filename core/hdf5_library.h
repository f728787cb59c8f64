#pragma once

#include <hdf5.h>

#include <string>

#include "core/hdf5.h"

/// What the parts of the HDF5 wrapper share of the C library: its errors, types and spaces. Private to core.
namespace wishbone::hdf5 {

/// Keeps the library from printing its error stack; restores the caller's setting.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// @throws InputError with what the library says of the cause
[[noreturn]] void fail_reading(const std::string& where, const std::string& what,
                               const std::string& remedy = {});
/// @throws NumericsError likewise
[[noreturn]] void fail_writing(const std::string& where, const std::string& what);

/// What H5Iget_name, H5Fget_name say.
std::string name_of(hid_t id, ssize_t (*get_name)(hid_t, char*, size_t));

/// "run.h5:/bodies/arm"
std::string place_of(hid_t object);
std::string where_is(const Object& object);

/// The same of an object to be made at `path` in a group.
std::string where_in(const Group& group, const std::string& path);

/// Object headers without time stamps: equal input, equal bytes.
Handle creation_properties(hid_t property_class);
/// Makes the groups above an object to be made, without time stamps too: those that the library makes on the way have them.
void make_groups_above(const Group& group, const std::string& path);

/// A text type as h5py and MATLAB like it best: UTF-8 of variable length.
Handle text_type();
Handle simple_space(const Shape& shape);

std::size_t element_count(const Shape& shape);
Shape shape_of(hid_t space);
bool is_number(hid_t type);

}  // namespace wishbone::hdf5
