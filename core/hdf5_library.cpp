#include "core/hdf5_library.h"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <string_view>

#include "core/descriptor.h"
#include "core/error.h"
#include "core/utf8.h"

namespace wishbone::hdf5 {
namespace {

/// The operating system's error number in a message such as "file write failed: time = Tue ..., errno = 28, error message = ...";
/// 0 when the fault is none of its.
int system_error_in(const std::string& message) {
  constexpr std::string_view kMark = "errno = ";
  const std::size_t at = message.find(kMark);
  return at == std::string::npos ? 0 : std::atoi(message.c_str() + at + kMark.size());
}

/// The innermost message of the current error stack: the cause, not the chain of callers.
std::string library_message() {
  std::string message;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned n, const H5E_error2_t* e, void* out) -> herr_t {
        if (n == 0 && e->desc) *static_cast<std::string*>(out) = e->desc;
        return 0;
      },
      &message);
  const int error_number = system_error_in(message);
  return error_number == 0 ? message : system_reason(error_number);
}

}  // namespace

std::string name_of(hid_t id, ssize_t (*get_name)(hid_t, char*, size_t)) {
  const ssize_t length = get_name(id, nullptr, 0);
  if (length <= 0) return {};
  std::string name(static_cast<std::size_t>(length) + 1, '\0');
  get_name(id, name.data(), name.size());
  name.pop_back();
  return name;
}

void fail_reading(const std::string& where, const std::string& what, const std::string& remedy) {
  const std::string cause = library_message();
  throw InputError({where, cause.empty() ? what : what + ": " + cause, "", remedy});
}

void fail_writing(const std::string& where, const std::string& what) {
  const std::string cause = library_message();
  throw NumericsError(
      {where, cause.empty() ? what : what + ": " + cause, "",
       "check the free space and the permissions of the folder, and that no other program has the "
       "file open"});
}

std::string place_of(hid_t object) {
  return as_utf8(name_of(object, H5Fget_name) + ":" + name_of(object, H5Iget_name));
}

std::string where_is(const Object& object) {
  return object.file_path() + ":" + object.path();
}

std::string where_in(const Group& group, const std::string& path) {
  const std::string parent = group.path();
  return group.file_path() + ":" + (path.starts_with('/') ? "" : parent == "/" ? "/" : parent + "/") + path;
}

Handle creation_properties(hid_t property_class) {
  Handle properties(H5Pcreate(property_class), H5Pclose);
  H5Pset_obj_track_times(properties.get(), false);
  return properties;
}

void make_groups_above(const Group& group, const std::string& path) {
  for (std::size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1)) {
    const std::string above = path.substr(0, end);
    if (H5Lexists(group.id(), above.c_str(), H5P_DEFAULT) > 0) continue;
    const Handle creation = creation_properties(H5P_GROUP_CREATE);
    const Handle made(H5Gcreate2(group.id(), above.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
                      H5Gclose);
    if (made.get() < 0) fail_writing(where_in(group, above), "cannot make the group");
  }
}

Handle text_type() {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.get(), H5T_VARIABLE);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  return type;
}

Handle simple_space(const Shape& shape) {
  const std::vector<hsize_t> lengths(shape.begin(), shape.end());
  if (lengths.empty()) return Handle(H5Screate(H5S_SCALAR), H5Sclose);
  return Handle(H5Screate_simple(static_cast<int>(lengths.size()), lengths.data(), nullptr), H5Sclose);
}

std::size_t element_count(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::size_t{1}, std::multiplies<>());
}

Shape shape_of(hid_t space) {
  std::vector<hsize_t> lengths(static_cast<std::size_t>(std::max(0, H5Sget_simple_extent_ndims(space))));
  H5Sget_simple_extent_dims(space, lengths.data(), nullptr);
  return Shape(lengths.begin(), lengths.end());
}

bool is_number(hid_t type) {
  const H5T_class_t kind = H5Tget_class(type);
  return kind == H5T_INTEGER || kind == H5T_FLOAT;
}

}  // namespace wishbone::hdf5
