#include "core/hdf5.h"

#include <fmt/core.h>
#include <fmt/ranges.h>
#include <hdf5.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "core/error.h"
#include "core/hdf5_library.h"
#include "core/input_file.h"

namespace wishbone::hdf5 {

static_assert(std::is_same_v<Handle::Id, hid_t>, "HDF5 1.10 or later has 64-bit identifiers");

namespace {

std::string name_of(hid_t id, ssize_t (*get_name)(hid_t, char*, size_t)) {
  const ssize_t length = get_name(id, nullptr, 0);
  if (length <= 0) return {};
  std::string name(static_cast<std::size_t>(length) + 1, '\0');
  get_name(id, name.data(), name.size());
  name.pop_back();
  return name;
}

std::string join(const std::string& parent, const std::string& path) {
  if (path.starts_with('/')) return path;
  return parent == "/" ? "/" + path : parent + "/" + path;
}

}  // namespace

void leave_out_exit_handler() {
  H5dont_atexit();
}

Handle::Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}

Handle& Handle::operator=(Handle&& other) noexcept {
  reset();
  id_ = std::exchange(other.id_, -1);
  close_ = other.close_;
  return *this;
}

bool Handle::reset() noexcept {
  if (id_ < 0) return true;
  const Silence silence;
  return close_(std::exchange(id_, -1)) >= 0;
}

std::string Object::path() const {
  return name_of(id(), H5Iget_name);
}

std::string Object::file_path() const {
  return name_of(id(), H5Fget_name);
}

Shape Dataset::shape() const {
  const Handle space(H5Dget_space(id()), H5Sclose);
  return shape_of(space.get());
}

bool Dataset::is_numeric() const {
  const Handle type(H5Dget_type(id()), H5Tclose);
  return is_number(type.get());
}

std::vector<double> Dataset::read() const {
  const Silence silence;
  const std::string where = where_is(*this);
  std::vector<double> values(element_count(shape()));
  if (!values.empty() && H5Dread(id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail_reading(where, "cannot read the dataset");
  return values;
}

std::vector<double> Dataset::read_rows(std::size_t rows) const {
  const Silence silence;
  const std::string where = where_is(*this);
  const Shape whole = shape();
  std::vector<hsize_t> start(whole.size(), 0), count(whole.begin(), whole.end());
  count.at(0) = rows;
  std::vector<double> values(rows * element_count({whole.begin() + 1, whole.end()}));
  if (values.empty()) return values;
  const Handle file_space(H5Dget_space(id()), H5Sclose);
  const Handle row_space(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  H5Sselect_hyperslab(file_space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  if (H5Dread(id(), H5T_NATIVE_DOUBLE, row_space.get(), file_space.get(), H5P_DEFAULT, values.data()) < 0)
    fail_reading(where, "cannot read the dataset");
  return values;
}

void Dataset::assign(std::span<const double> values) {
  const Silence silence;
  const std::string where = where_is(*this);
  if (values.size() != element_count(shape()))
    throw InputError({where, "the number of values differs from the size of the dataset",
                      fmt::format("{}", values.size()), ""});
  if (H5Dwrite(id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail_writing(where, "cannot write the dataset");
}

bool Group::contains(const std::string& path) const {
  const Silence silence;
  // The library wants every parent checked before the child.
  for (std::size_t end = path.find('/', 1); end != std::string::npos; end = path.find('/', end + 1))
    if (H5Lexists(id(), path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
  return path == "/" || H5Lexists(id(), path.c_str(), H5P_DEFAULT) > 0;
}

std::vector<std::string> Group::members() const {
  std::vector<std::string> names;
  H5Literate(
      id(), H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
      },
      &names);
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<std::string> Group::dataset_paths() const {
  const Silence silence;
  const std::string where = where_is(*this);
  std::vector<std::string> paths;
  const auto note = [](hid_t, const char* name, const H5O_info_t* info, void* out) -> herr_t {
    if (info->type == H5O_TYPE_DATASET) static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  if (H5Ovisit2(id(), H5_INDEX_NAME, H5_ITER_INC, note, &paths, H5O_INFO_BASIC) < 0)
    fail_reading(where, "cannot list the group");
  for (std::string& p : paths) p = join(path(), p);
  std::sort(paths.begin(), paths.end());
  return paths;
}

namespace {

/// Tells what the deepest existing ancestor of a missing path has to offer.
[[noreturn]] void fail_missing(const Group& group, const std::string& path, const std::string& kind) {
  std::string parent = path;
  do {
    const std::size_t slash = parent.rfind('/');
    parent = slash == std::string::npos ? "" : slash == 0 ? "/" : parent.substr(0, slash);
  } while (!parent.empty() && parent != "/" && !group.contains(parent));
  std::vector<std::string> names;
  const Handle opened(H5Gopen2(group.id(), parent.empty() ? "." : parent.c_str(), H5P_DEFAULT), H5Gclose);
  if (opened.get() >= 0) names = parent.empty() ? group.members() : group.open_group(parent).members();
  constexpr std::size_t kShown = 20;
  const bool more = names.size() > kShown;
  if (more) names.resize(kShown);
  const std::string inside = parent.empty() ? group.path() : join(group.path(), parent);
  throw InputError({group.file_path() + ":" + join(group.path(), path), "no such " + kind, "",
                    names.empty()
                        ? inside + " is empty"
                        : fmt::format("{} has: {}{}", inside, fmt::join(names, ", "), more ? ", ..." : "")});
}

}  // namespace

Group Group::open_group(const std::string& path) const {
  const Silence silence;
  Handle handle(H5Gopen2(id(), path.c_str(), H5P_DEFAULT), H5Gclose);
  if (handle.get() < 0) fail_missing(*this, path, "group");
  return Group(std::move(handle));
}

Dataset Group::open_dataset(const std::string& path) const {
  const Silence silence;
  Handle handle(H5Dopen2(id(), path.c_str(), H5P_DEFAULT), H5Dclose);
  if (handle.get() < 0) fail_missing(*this, path, "dataset");
  return Dataset(std::move(handle));
}

Group Group::create_group(const std::string& path) {
  if (contains(path)) return open_group(path);
  const Silence silence;
  const std::string where = where_in(*this, path);
  make_groups_above(*this, path);
  const Handle creation = creation_properties(H5P_GROUP_CREATE);
  {
    const Handle made(H5Gcreate2(id(), path.c_str(), H5P_DEFAULT, creation.get(), H5P_DEFAULT), H5Gclose);
    if (made.get() < 0) fail_writing(where, "cannot make the group");
  }
  return open_group(path);
}

Dataset Group::write(const std::string& path, const Shape& shape, std::span<const double> values) {
  const Silence silence;
  const std::string where = where_in(*this, path);
  if (values.size() != element_count(shape))
    throw InputError({where, "the number of values differs from what the shape says",
                      fmt::format("{} values for a shape of {}", values.size(), element_count(shape)), ""});
  make_groups_above(*this, path);
  const Handle creation = creation_properties(H5P_DATASET_CREATE);
  const Handle space = simple_space(shape);
  Dataset dataset(Handle(
      H5Dcreate2(id(), path.c_str(), H5T_IEEE_F64LE, space.get(), H5P_DEFAULT, creation.get(), H5P_DEFAULT),
      H5Dclose));
  if (dataset.id() < 0) fail_writing(where, "cannot make the dataset");
  if (!values.empty() &&
      H5Dwrite(dataset.id(), H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail_writing(where, "cannot write the dataset");
  return dataset;
}

Dataset Group::write(const std::string& path, const Eigen::Ref<const MatrixX>& matrix) {
  const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> rows = matrix;
  return write(path, {static_cast<std::size_t>(rows.rows()), static_cast<std::size_t>(rows.cols())},
               {rows.data(), static_cast<std::size_t>(rows.size())});
}

MatrixX Group::read_matrix(const std::string& path) const {
  const Dataset dataset = open_dataset(path);
  const Shape shape = dataset.shape();
  if (shape.size() > 2)
    throw InputError(
        {where_is(dataset), "a matrix has at most two dimensions", fmt::format("{}", shape.size()), ""});
  const auto rows = static_cast<Eigen::Index>(shape.empty() ? 1 : shape[0]);
  const auto columns = static_cast<Eigen::Index>(shape.size() < 2 ? 1 : shape[1]);
  const std::vector<double> values = dataset.read();
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), rows, columns);
}

File File::open(const std::string& path) {
  const Silence silence;
  if (const auto fault = input_fault(path)) throw InputError({path, fault->what, "", fault->remedy});
  if (H5Fis_hdf5(path.c_str()) == 0)
    throw InputError({path, "this is not an HDF5 file", "", "give a file written by wishbone (.h5)"});
  Handle file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (file.get() < 0)
    fail_reading(path, "cannot open the file", "is a program still writing it, or was it cut short?");
  Handle root(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose);
  if (root.get() < 0) fail_reading(path, "cannot open the root group");
  return File(std::move(file), std::move(root));
}

File File::create(const std::string& path) {
  const Silence silence;
  const Handle creation = creation_properties(H5P_FILE_CREATE);
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fclose_degree(access.get(), H5F_CLOSE_STRONG);
  // The format of HDF5 1.8: attributes may exceed 64 KiB, as the list of what hangs on a dimension scale does.
  H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  Handle file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()), H5Fclose);
  if (file.get() < 0) fail_writing(path, "cannot make the file");
  Handle root(H5Gopen2(file.get(), "/", H5P_DEFAULT), H5Gclose);
  if (root.get() < 0) fail_writing(path, "cannot open the root group");
  return File(std::move(file), std::move(root));
}

void File::close() {
  const std::string path = file_path();
  {
    const Silence silence;
    if (H5Fflush(file_.get(), H5F_SCOPE_GLOBAL) < 0) fail_writing(path, "cannot write");
  }
  const bool closed_root = handle_.reset();
  if (!file_.reset() || !closed_root) fail_writing(path, "cannot close the file");
}

}  // namespace wishbone::hdf5
