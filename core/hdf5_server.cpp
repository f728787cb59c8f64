#include "core/hdf5_server.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <new>
#include <optional>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/hdf5_library.h"
#include "core/packed_bytes.h"
#include "core/utf8.h"

namespace wishbone::hdf5 {
namespace {

std::string attribute_place(hid_t object, const std::string& name) {
  return place_of(object) + "@" + name;
}

Handle opened(Handle handle, const std::string& where, const char* what) {
  if (handle.get() < 0) fail_reading(where, what);
  return handle;
}

std::size_t count_of(hid_t space, const std::string& where) {
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  if (count < 0) fail_reading(where, "cannot tell the size");
  return static_cast<std::size_t>(count);
}

/// Texts of fixed or variable length.
std::vector<std::string> read_texts(hid_t attribute, hid_t stored, hid_t space, const std::string& where) {
  const std::size_t count = count_of(space, where);
  std::vector<std::string> texts;
  if (count == 0) return texts;  // H5Aread refuses the null buffer
  if (H5Tis_variable_str(stored) > 0) {
    std::vector<char*> pointers(count, nullptr);
    const Handle type = text_type();
    H5Tset_cset(type.get(), H5Tget_cset(stored));
    if (H5Aread(attribute, type.get(), pointers.data()) < 0) fail_reading(where, "cannot read the attribute");
    for (const char* text : pointers) texts.push_back(as_utf8(text ? text : ""));
    H5Dvlen_reclaim(type.get(), space, H5P_DEFAULT, pointers.data());
  } else {
    const std::size_t size = H5Tget_size(stored);
    if (size == 0 || count > std::numeric_limits<std::size_t>::max() / size) throw std::bad_alloc();
    std::string characters(count * size, '\0');
    if (H5Aread(attribute, stored, characters.data()) < 0) fail_reading(where, "cannot read the attribute");
    for (std::size_t i = 0; i < count; ++i)
      texts.push_back(as_utf8(characters.substr(i * size, size).c_str()));
  }
  return texts;
}

/// Nothing for a type that a Value cannot hold.
std::optional<Value> read_attribute(hid_t object, const std::string& name) {
  const std::string where = attribute_place(object, name);
  const Handle attribute =
      opened({H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose}, where, "cannot open the attribute");
  const Handle type = opened({H5Aget_type(attribute.get()), H5Tclose}, where, "cannot tell the type");
  const Handle space = opened({H5Aget_space(attribute.get()), H5Sclose}, where, "cannot tell the size");
  if (is_number(type.get()) && count_of(space.get(), where) == 1) {
    double number = 0;
    if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &number) < 0)
      fail_reading(where, "cannot read the attribute");
    return number;
  }
  if (H5Tget_class(type.get()) != H5T_STRING) return {};
  std::vector<std::string> texts = read_texts(attribute.get(), type.get(), space.get(), where);
  if (H5Sget_simple_extent_type(space.get()) == H5S_SCALAR && texts.size() == 1) return texts.front();
  return texts;
}

void read_attributes(hid_t object, ObjectFacts& facts) {
  std::vector<std::string> names;
  const auto note = [](hid_t, const char* name, const H5A_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->emplace_back(name);
    return 0;
  };
  if (H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_INC, nullptr, note, &names) < 0)
    fail_reading(place_of(object), "cannot list the attributes");
  for (const std::string& name : names) {
    if (auto value = read_attribute(object, name))
      facts.attributes.emplace(as_utf8(name), std::move(*value));
    else
      facts.others.insert(as_utf8(name));
  }
}

struct Link {
  std::string name;  ///< relative to the root
  bool is_hard;
};

std::vector<Link> links_below(hid_t root, const std::string& where) {
  std::vector<Link> links;
  const auto note = [](hid_t, const char* name, const H5L_info_t* info, void* out) -> herr_t {
    static_cast<std::vector<Link>*>(out)->push_back({name, info->type == H5L_TYPE_HARD});
    return 0;
  };
  if (H5Lvisit(root, H5_INDEX_NAME, H5_ITER_INC, note, &links) < 0)
    fail_reading(where, "cannot list the groups");
  return links;
}

double file_size(hid_t object) {
  const Handle file(H5Iget_file_id(object), H5Fclose);
  hsize_t bytes = 0;
  H5Fget_filesize(file.get(), &bytes);
  return static_cast<double>(bytes);
}

/// Bytes that a dataset can hold at most, by what it takes in its file: deflate packs a thousandfold, at most.
double most_bytes(hid_t dataset) {
  constexpr double kDensest = 1100;
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  const H5D_layout_t layout = H5Pget_layout(creation.get());
  if (layout == H5D_VIRTUAL) return file_size(dataset);  // shows parts of others
  const double stored = std::min(static_cast<double>(H5Dget_storage_size(dataset)), file_size(dataset));
  if (layout != H5D_CHUNKED) return stored;
  const Handle space(H5Dget_space(dataset), H5Sclose);
  std::vector<hsize_t> lengths(shape_of(space.get()).size());
  hsize_t chunks = 0;
  if (H5Pget_chunk(creation.get(), static_cast<int>(lengths.size()), lengths.data()) < 0 ||
      H5Dget_num_chunks(dataset, space.get(), &chunks) < 0)
    return 0;
  const Handle type(H5Dget_type(dataset), H5Tclose);
  double in_chunks = static_cast<double>(chunks) * static_cast<double>(H5Tget_size(type.get()));
  for (const hsize_t length : lengths) in_chunks *= static_cast<double>(length);
  return std::min(kDensest * stored, in_chunks);
}

void check_size(hid_t dataset, const Shape& shape, std::size_t rows) {
  constexpr double kAlwaysFine = 16e6;  // [bytes]; numbers that were never written take no room in the file
  const Handle type(H5Dget_type(dataset), H5Tclose);
  double bytes = static_cast<double>(H5Tget_size(type.get()));
  for (std::size_t i = 0; i < shape.size(); ++i) bytes *= static_cast<double>(i == 0 ? rows : shape[i]);
  if (bytes > kAlwaysFine && bytes > most_bytes(dataset))
    throw InputError({place_of(dataset), "the dataset claims more numbers than its file can hold",
                      fmt::format("[{}]", fmt::join(shape, ", ")), "take an intact copy, or write it again"});
}

/// Rows to be read at a time: whole chunks, which are unpacked but once, of a few megabytes together.
std::size_t rows_at_a_time(hid_t dataset, const Shape& shape) {
  constexpr double kBytes = 4e6;
  const Handle creation(H5Dget_create_plist(dataset), H5Pclose);
  std::vector<hsize_t> chunk(shape.size(), 1);
  if (H5Pget_layout(creation.get()) == H5D_CHUNKED)
    H5Pget_chunk(creation.get(), static_cast<int>(chunk.size()), chunk.data());
  double bytes = sizeof(double) * static_cast<double>(std::max<hsize_t>(chunk[0], 1));
  for (std::size_t i = 1; i < shape.size(); ++i)
    bytes *= static_cast<double>(std::max<std::size_t>(shape[i], 1));
  const double chunks = std::clamp(kBytes / bytes, 1.0, kBytes);
  return static_cast<std::size_t>(std::max<hsize_t>(chunk[0], 1)) * static_cast<std::size_t>(chunks);
}

std::string_view bytes_of(const std::vector<double>& values) {
  return {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(double)};
}

void read_block(hid_t dataset, hid_t memory_space, hid_t file_space, std::vector<double>& values) {
  if (H5Dread(dataset, H5T_NATIVE_DOUBLE, memory_space, file_space, H5P_DEFAULT, values.data()) < 0)
    fail_reading(place_of(dataset), "cannot read the dataset");
}

}  // namespace

std::string packed_request(const std::string& path, std::size_t rows) {
  PackedBytes bytes;
  bytes.put(path);
  bytes.put(static_cast<std::uint64_t>(rows));
  return bytes.text();
}

void Server::answer(std::string_view request, const IsolatedProcess::Send& send) {
  const Silence silence;
  if (file_.get() < 0) open();
  if (request.empty()) return send(packed(contents()));
  PackedReader bytes(request);
  const std::string path = bytes.text();
  send_rows(path, bytes.number<std::uint64_t>(), send);
}

void Server::open() {
  if (H5Fis_hdf5(path_.c_str()) == 0)
    throw InputError({path_, "this is not an HDF5 file", "", "give a file written by wishbone (.h5)"});
  file_ = Handle(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (file_.get() < 0)
    fail_reading(path_, "cannot open the file", "is a program still writing it, or was it cut short?");
}

Contents Server::contents() {
  std::vector<Link> links = links_below(file_.get(), path_);
  links.insert(links.begin(), {".", true});
  Contents contents;
  for (const auto& [name, is_hard] : links) {
    const Handle object(H5Oopen(file_.get(), name.c_str(), H5P_DEFAULT), H5Oclose);
    if (object.get() < 0 && !is_hard) continue;  // names what is not there
    const std::string path = name == "." ? "/" : "/" + name;
    if (object.get() < 0) fail_reading(path_ + ":" + as_utf8(path), "cannot open the object");
    const H5I_type_t kind = H5Iget_type(object.get());
    if (kind != H5I_DATASET && kind != H5I_GROUP) continue;
    ObjectFacts facts;
    facts.is_dataset = kind == H5I_DATASET;
    if (facts.is_dataset) {
      const Handle type =
          opened({H5Dget_type(object.get()), H5Tclose}, place_of(object.get()), "cannot tell the type");
      const Handle space =
          opened({H5Dget_space(object.get()), H5Sclose}, place_of(object.get()), "cannot tell the shape");
      facts.is_numeric = is_number(type.get());
      facts.shape = shape_of(space.get());
    }
    read_attributes(object.get(), facts);
    names_[as_utf8(path)] = path;
    contents[as_utf8(path)] = std::move(facts);
  }
  return contents;
}

void Server::send_rows(const std::string& path, std::size_t rows, const IsolatedProcess::Send& send) {
  const Handle dataset = opened({H5Dopen2(file_.get(), names_.at(path).c_str(), H5P_DEFAULT), H5Dclose},
                                path_ + ":" + path, "cannot open the dataset");
  const Handle space =
      opened({H5Dget_space(dataset.get()), H5Sclose}, place_of(dataset.get()), "cannot tell the shape");
  const Shape shape = shape_of(space.get());
  check_size(dataset.get(), shape, rows);
  if (shape.empty()) {
    std::vector<double> scalar(1);
    read_block(dataset.get(), H5S_ALL, H5S_ALL, scalar);
    return send(bytes_of(scalar));
  }
  std::vector<hsize_t> start(shape.size(), 0), count(shape.begin(), shape.end());
  const std::size_t row_length = element_count({shape.begin() + 1, shape.end()});
  const std::size_t step = rows_at_a_time(dataset.get(), shape);
  std::vector<double> values;
  for (std::size_t row = 0; row < rows && row_length > 0; row += step) {
    start[0] = row;
    count[0] = std::min(step, rows - row);
    values.resize(count[0] * row_length);
    const Handle block(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
    H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
    read_block(dataset.get(), block.get(), space.get(), values);
    send(bytes_of(values));
  }
}

}  // namespace wishbone::hdf5
