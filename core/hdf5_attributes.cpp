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

}  // namespace wishbone::hdf5
