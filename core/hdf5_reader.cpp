#include "core/hdf5_reader.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cstring>
#include <filesystem>
#include <functional>
#include <numeric>
#include <utility>
#include <variant>

#include "core/error.h"
#include "core/hdf5_contents.h"
#include "core/hdf5_server.h"
#include "core/input_file.h"
#include "core/isolated_process.h"

namespace wishbone::hdf5 {

namespace {

/// What reading a file of this size may take: far more than any intact one does.
IsolatedProcess::Limits limits_for(std::uintmax_t bytes) {
  constexpr double kSlowest = 3e6;  // [bytes/s]
  IsolatedProcess::Limits limits;
  limits.processor_seconds = 0.5 + static_cast<double>(bytes) / kSlowest;
  limits.memory_bytes += 16 * bytes;
  return limits;
}

std::uintmax_t size_of_file(const std::string& path) {
  if (const auto fault = input_fault(path)) throw InputError({path, fault->what, "", fault->remedy});
  std::error_code unknown;
  return std::filesystem::file_size(path, unknown);
}

}  // namespace

/// A file: what is in it, and who reads its numbers.
class ReadContents {
 public:
  explicit ReadContents(const std::string& path)
      : path_(path),
        process_(path, limits_for(size_of_file(path)),
                 [server = std::make_shared<Server>(path)](std::string_view request, const auto& send) {
                   server->answer(request, send);
                 }) {
    process_.ask({}, [this](std::string_view bytes) { objects_ = unpacked_contents(bytes); });
  }

  const std::string& path() const { return path_; }
  const Contents& objects() const { return objects_; }
  const ObjectFacts& object(const std::string& path) const { return objects_.at(path); }

  std::vector<double> read(const std::string& path, std::size_t rows) {
    std::vector<double> values;
    process_.ask(packed_request(path, rows), [&](std::string_view bytes) {
      const std::size_t before = values.size();
      values.resize(before + bytes.size() / sizeof(double));
      std::memcpy(values.data() + before, bytes.data(), bytes.size());
    });
    return values;
  }

 private:
  std::string path_;
  Contents objects_;
  IsolatedProcess process_;
};

ObjectReader::ObjectReader(std::shared_ptr<ReadContents> file, std::string path)
    : file_(std::move(file)), path_(std::move(path)) {}

const std::string& ObjectReader::file_path() const {
  return file_->path();
}

bool ObjectReader::has_attribute(const std::string& name) const {
  return attributes().contains(name) || file_->object(path_).others.contains(name);
}

const Value& ObjectReader::attribute(const std::string& name) const {
  const auto found = attributes().find(name);
  if (found != attributes().end()) return found->second;
  throw InputError({fmt::format("{}:{}@{}", file_path(), path_, name),
                    has_attribute(name) ? "the attribute is neither a number nor text" : "no such attribute",
                    "", ""});
}

std::string ObjectReader::text_attribute(const std::string& name) const {
  const auto found = attributes().find(name);
  if (found == attributes().end()) return {};
  const auto* text = std::get_if<std::string>(&found->second);
  return text ? *text : std::string();
}

const std::map<std::string, Value>& ObjectReader::attributes() const {
  return file_->object(path_).attributes;
}

const Shape& DatasetReader::shape() const {
  return file_->object(path_).shape;
}

bool DatasetReader::is_numeric() const {
  return file_->object(path_).is_numeric;
}

std::vector<double> DatasetReader::read() const {
  return read_rows(shape().empty() ? 1 : shape()[0]);
}

std::vector<double> DatasetReader::read_rows(std::size_t rows) const {
  const Shape& lengths = shape();
  const std::size_t row_length = lengths.empty() ? 1
                                                 : std::accumulate(lengths.begin() + 1, lengths.end(),
                                                                   std::size_t{1}, std::multiplies<>());
  std::vector<double> values = file_->read(path_, rows);
  if (values.size() != rows * row_length)
    throw InputError({file_path() + ":" + path_, "the dataset has not the numbers that it claims",
                      fmt::format("{} of {}", values.size(), rows * row_length),
                      "take an intact copy, or write it again"});
  return values;
}

bool GroupReader::contains(const std::string& path) const {
  return file_->objects().contains(joined_path(path_, path));
}

std::vector<std::string> GroupReader::members() const {
  const std::string start = path_ == "/" ? path_ : path_ + "/";
  std::vector<std::string> names;
  for (auto object = file_->objects().lower_bound(start);
       object != file_->objects().end() && object->first.starts_with(start); ++object) {
    const std::string name = object->first.substr(start.size());
    if (!name.empty() && name.find('/') == std::string::npos) names.push_back(name);
  }
  return names;
}

std::vector<std::string> GroupReader::dataset_paths() const {
  const std::string start = path_ == "/" ? path_ : path_ + "/";
  std::vector<std::string> paths;
  for (auto object = file_->objects().lower_bound(start);
       object != file_->objects().end() && object->first.starts_with(start); ++object)
    if (object->second.is_dataset) paths.push_back(object->first);
  return paths;
}

std::string GroupReader::find(const std::string& path, bool dataset) const {
  const Contents& objects = file_->objects();
  const std::string wanted = joined_path(path_, path);
  if (const auto found = objects.find(wanted); found != objects.end() && found->second.is_dataset == dataset)
    return wanted;
  // what the deepest existing group above has to offer
  std::string parent = wanted;
  do parent.resize(parent.rfind('/'));
  while (!parent.empty() && !objects.contains(parent));
  if (parent.empty()) parent = "/";
  std::vector<std::string> names = GroupReader(file_, parent).members();
  constexpr std::size_t kShown = 20;
  const bool more = names.size() > kShown;
  if (more) names.resize(kShown);
  throw InputError({file_path() + ":" + wanted, dataset ? "no such dataset" : "no such group", "",
                    names.empty()
                        ? parent + " is empty"
                        : fmt::format("{} has: {}{}", parent, fmt::join(names, ", "), more ? ", ..." : "")});
}

GroupReader GroupReader::open_group(const std::string& path) const {
  return {file_, find(path, false)};
}

DatasetReader GroupReader::open_dataset(const std::string& path) const {
  return {file_, find(path, true)};
}

MatrixX GroupReader::read_matrix(const std::string& path) const {
  const DatasetReader dataset = open_dataset(path);
  const Shape& shape = dataset.shape();
  const std::string where = dataset.file_path() + ":" + dataset.path();
  if (!dataset.is_numeric()) throw InputError({where, "the dataset does not hold numbers", "", ""});
  if (shape.size() > 2)
    throw InputError({where, "a matrix has at most two dimensions", fmt::format("{}", shape.size()), ""});
  const auto rows = static_cast<Eigen::Index>(shape.empty() ? 1 : shape[0]);
  const auto columns = static_cast<Eigen::Index>(shape.size() < 2 ? 1 : shape[1]);
  const std::vector<double> values = dataset.read();
  return Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
      values.data(), rows, columns);
}

FileReader::FileReader(const std::string& path) : GroupReader(std::make_shared<ReadContents>(path), "/") {}

}  // namespace wishbone::hdf5
