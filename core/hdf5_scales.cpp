#include <hdf5_hl.h>

#include <cstddef>
#include <utility>

#include "core/error.h"
#include "core/hdf5_library.h"

// Which dataset lies along which scale is written here, not by the library: that writes the list of a scale anew for every
// dataset that is attached, and wants it to fit in 64 KiB.
namespace wishbone::hdf5 {
namespace {

static_assert(sizeof(hobj_ref_t) == sizeof(std::uint64_t));

std::uint64_t reference_to(const Object& object) {
  hobj_ref_t reference = 0;
  if (H5Rcreate(&reference, object.id(), ".", H5R_OBJECT, -1) < 0)
    fail_writing(where_is(object), "cannot refer to the object");
  return reference;
}

void write_attribute(const Object& object, const char* name, hid_t type, std::size_t length,
                     const void* elements) {
  const Handle space = simple_space({length});
  const Handle attribute(H5Acreate2(object.id(), name, type, space.get(), H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (attribute.get() < 0 || H5Awrite(attribute.get(), type, elements) < 0)
    fail_writing(where_is(object) + "@" + name, "cannot write the attribute");
}

}  // namespace

void Dataset::attach_scales(std::span<Scale* const> scales) {
  const Silence silence;
  const std::uint64_t self = reference_to(*this);
  std::vector<std::uint64_t> references;
  for (std::size_t dimension = 0; dimension < scales.size(); ++dimension) {
    references.push_back(reference_to(scales[dimension]->dataset_));
    scales[dimension]->uses_.push_back({self, static_cast<std::uint32_t>(dimension)});
  }
  std::vector<hvl_t> lists;
  for (std::uint64_t& reference : references) lists.push_back({1, &reference});
  const Handle type(H5Tvlen_create(H5T_STD_REF_OBJ), H5Tclose);
  write_attribute(*this, "DIMENSION_LIST", type.get(), lists.size(), lists.data());
}

Scale::Scale(Dataset dataset, const std::string& name) : dataset_(std::move(dataset)) {
  const Silence silence;
  if (H5DSset_scale(dataset_.id(), name.c_str()) < 0)
    fail_writing(where_is(dataset_), "cannot make a dimension scale");
}

void Scale::finish() {
  if (uses_.empty()) return;
  const Silence silence;
  const Handle type(H5Tcreate(H5T_COMPOUND, sizeof(Use)), H5Tclose);
  H5Tinsert(type.get(), "dataset", offsetof(Use, dataset), H5T_STD_REF_OBJ);
  H5Tinsert(type.get(), "dimension", offsetof(Use, dimension), H5T_NATIVE_UINT32);
  write_attribute(dataset_, "REFERENCE_LIST", type.get(), uses_.size(), uses_.data());
}

}  // namespace wishbone::hdf5
