#include <algorithm>

#include "core/error.h"
#include "core/hdf5_library.h"

namespace wishbone::hdf5 {
namespace {

void write_texts(hid_t attribute, std::span<const std::string> texts, const std::string& where) {
  std::vector<const char*> pointers;
  for (const std::string& text : texts) pointers.push_back(text.c_str());
  const Handle type = text_type();
  if (H5Awrite(attribute, type.get(), pointers.data()) < 0) fail_writing(where, "cannot write the attribute");
}

/// Texts of fixed or variable length.
std::vector<std::string> read_texts(hid_t attribute, hid_t stored_type, hid_t space,
                                    const std::string& where) {
  const auto count = static_cast<std::size_t>(H5Sget_simple_extent_npoints(space));
  std::vector<std::string> texts;
  if (count == 0) return texts;  // H5Aread refuses the null buffer
  if (H5Tis_variable_str(stored_type) > 0) {
    std::vector<char*> pointers(count, nullptr);
    const Handle type = text_type();
    H5Tset_cset(type.get(), H5Tget_cset(stored_type));
    if (H5Aread(attribute, type.get(), pointers.data()) < 0) fail_reading(where, "cannot read the attribute");
    for (const char* text : pointers) texts.emplace_back(text ? text : "");
    H5Dvlen_reclaim(type.get(), space, H5P_DEFAULT, pointers.data());
  } else {
    const std::size_t size = H5Tget_size(stored_type);
    std::string characters(count * size, '\0');
    if (H5Aread(attribute, stored_type, characters.data()) < 0)
      fail_reading(where, "cannot read the attribute");
    for (std::size_t i = 0; i < count; ++i) texts.emplace_back(characters.substr(i * size, size).c_str());
  }
  return texts;
}

}  // namespace

void Object::set_attribute(const std::string& name, const Value& value) {
  const Silence silence;
  const std::string where = where_is(*this) + "@" + name;
  if (H5Aexists(id(), name.c_str()) > 0) H5Adelete(id(), name.c_str());
  const auto create = [&](hid_t type, const Shape& shape) {
    const Handle space = simple_space(shape);
    Handle attribute(H5Acreate2(id(), name.c_str(), type, space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    if (attribute.get() < 0) fail_writing(where, "cannot make the attribute");
    return attribute;
  };
  if (const auto* number = std::get_if<double>(&value)) {
    if (H5Awrite(create(H5T_IEEE_F64LE, {}).get(), H5T_NATIVE_DOUBLE, number) < 0)
      fail_writing(where, "cannot write the attribute");
  } else if (const auto* text = std::get_if<std::string>(&value)) {
    write_texts(create(text_type().get(), {}).get(), {text, 1}, where);
  } else {
    const auto& texts = std::get<std::vector<std::string>>(value);
    if (texts.empty()) {
      create(text_type().get(), {0});  // no element: there is nothing to write
      return;
    }
    write_texts(create(text_type().get(), {texts.size()}).get(), texts, where);
  }
}

bool Object::has_attribute(const std::string& name) const {
  return H5Aexists(id(), name.c_str()) > 0;
}

Value Object::attribute(const std::string& name) const {
  const Silence silence;
  const std::string where = where_is(*this) + "@" + name;
  const Handle attribute(H5Aopen(id(), name.c_str(), H5P_DEFAULT), H5Aclose);
  if (attribute.get() < 0) fail_reading(where, "no such attribute");
  const Handle type(H5Aget_type(attribute.get()), H5Tclose);
  const Handle space(H5Aget_space(attribute.get()), H5Sclose);
  const bool scalar =
      H5Sget_simple_extent_npoints(space.get()) == 1 && H5Sget_simple_extent_ndims(space.get()) == 0;
  if (is_number(type.get()) && H5Sget_simple_extent_npoints(space.get()) == 1) {
    double number = 0;
    if (H5Aread(attribute.get(), H5T_NATIVE_DOUBLE, &number) < 0)
      fail_reading(where, "cannot read the attribute");
    return number;
  }
  if (H5Tget_class(type.get()) != H5T_STRING)
    throw InputError({where, "the attribute is neither a number nor text", "", ""});
  std::vector<std::string> texts = read_texts(attribute.get(), type.get(), space.get(), where);
  if (scalar) return texts.front();
  return texts;
}

std::string Object::text_attribute(const std::string& name) const {
  if (!has_attribute(name)) return {};
  const Value value = attribute(name);
  const auto* text = std::get_if<std::string>(&value);
  return text ? *text : std::string();
}

std::map<std::string, Value> Object::attributes() const {
  std::vector<std::string> names;
  H5Aiterate2(
      id(), H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* name, const H5A_info_t*, void* out) -> herr_t {
        static_cast<std::vector<std::string>*>(out)->emplace_back(name);
        return 0;
      },
      &names);
  std::map<std::string, Value> values;
  for (const std::string& name : names) {
    const Handle attribute(H5Aopen(id(), name.c_str(), H5P_DEFAULT), H5Aclose);
    const Handle type(H5Aget_type(attribute.get()), H5Tclose);
    const Handle space(H5Aget_space(attribute.get()), H5Sclose);
    const bool number = is_number(type.get()) && H5Sget_simple_extent_npoints(space.get()) == 1;
    if (number || H5Tget_class(type.get()) == H5T_STRING) values.emplace(name, this->attribute(name));
  }
  return values;
}

}  // namespace wishbone::hdf5
