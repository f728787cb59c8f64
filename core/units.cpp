#include "core/units.h"

#include <fmt/format.h>
#include <udunits2.h>

#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <mutex>
#include <optional>

#include "core/error.h"

namespace wishbone {
namespace {

constexpr std::array kDimensions{
    kRatio, kLength, kMass,      kTime,    kAngle,   kVelocity, kAngularVelocity, kAcceleration,
    kForce, kMoment, kStiffness, kDamping, kInertia, kDensity,  kPressure,        kForcePerAngle};

struct UnitDeleter {
  void operator()(ut_unit* unit) const { ut_free(unit); }
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, UnitDeleter>;
using Converter = std::unique_ptr<cv_converter, UnitDeleter>;

/// The units database, read once per process. udunits2 parses with global state, hence the mutex.
class UnitSystem {
 public:
  static UnitSystem& instance() {
    static UnitSystem system;
    return system;
  }

  /// Scale and base of a unit; nothing when the text is not a unit that is proportional to its base.
  struct Scale {
    double factor;
    std::string base;
  };
  std::optional<Scale> scale(const std::string& unit_text) {
    const std::lock_guard lock(mutex_);
    const Unit unit(ut_parse(system_, unit_text.c_str(), UT_UTF8));
    if (!unit) return std::nullopt;
    const std::string base = base_of(*unit);
    const Unit base_unit(ut_parse(system_, base.c_str(), UT_ASCII));
    if (!base_unit) return std::nullopt;
    const Converter to_base(ut_get_converter(unit.get(), base_unit.get()));
    if (!to_base || cv_convert_double(to_base.get(), 0.0) != 0.0) return std::nullopt;  // degrees Celsius, dB
    return Scale{cv_convert_double(to_base.get(), 1.0), base};
  }

 private:
  UnitSystem() {
    ut_set_error_message_handler(ut_ignore);
    system_ = ut_read_xml(nullptr);
    if (!system_) {
      throw InputError({"", "the units database of udunits2 cannot be read",
                        ut_get_path_xml(nullptr, nullptr),
                        "install libudunits2-data or set UDUNITS2_XML_PATH"});
    }
    const Unit degree(ut_get_unit_by_name(system_, "degree"));
    ut_map_name_to_unit("deg", UT_ASCII, degree.get());  // the database knows degree, degrees and ° only
  }
  UnitSystem(const UnitSystem&) = delete;
  UnitSystem& operator=(const UnitSystem&) = delete;

  /// "kg.s-2" of kN/m: udunits2 prints "1000 kg.s-2", or "kg.s-2" when the factor is one.
  static std::string base_of(const ut_unit& unit) {
    std::array<char, 256> buffer{};
    const int length = ut_format(&unit, buffer.data(), buffer.size(), UT_ASCII | UT_DEFINITION);
    if (length < 0 || length >= static_cast<int>(buffer.size())) return "";
    const std::string definition(buffer.data());
    return definition.substr(definition.rfind(' ') + 1);
  }

  std::mutex mutex_;
  ut_system* system_ = nullptr;
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlank = " \t\r\n";
  const auto first = text.find_first_not_of(kBlank);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlank) - first + 1);
}

/// udunits2 takes a number as a factor of the unit; here the only number is the one in front (`5 1/s`
/// excepted).
bool looks_like_unit(std::string_view text) {
  const char c = text.front();
  const bool begins_with_digit = c >= '0' && c <= '9';
  return text.size() <= 64 && c != '-' && c != '+' && c != '.' &&
         (!begins_with_digit || text.starts_with("1/"));
}

}  // namespace

bool looks_like_number(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
  if (text.starts_with('.')) text.remove_prefix(1);
  return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

Quantity parse_quantity(std::string_view text) {
  text = trimmed(text);
  if (!looks_like_number(text)) {
    throw InputError({"", "not a finite number", fmt::format("'{}'", text),
                      "write a number such as 0.5 or 1e3, or a number and a unit such as 120 km/h"});
  }
  Quantity quantity;
  const char* first = text.data() + (text.front() == '+' ? 1 : 0);
  const char* last = text.data() + text.size();
  const auto [end, error] = std::from_chars(first, last, quantity.value);
  if (error != std::errc()) {
    throw InputError({"", "the number does not fit a double", fmt::format("'{}'", text),
                      "magnitudes from 2.3e-308 to 1.7e308, and 0, can be held"});
  }

  const std::string unit(trimmed({end, static_cast<std::size_t>(last - end)}));
  if (unit.empty()) return quantity;
  const auto scale = looks_like_unit(unit) ? UnitSystem::instance().scale(unit) : std::nullopt;
  if (!scale) {
    throw InputError({"", fmt::format("unknown unit '{}'", unit), fmt::format("'{}'", text),
                      "write units as in 120 km/h, 47 kN/m, 4 kN s/m, 2 kg m2, 6 deg, 5 ms or 5 %; a plain "
                      "number is in SI units"});
  }
  quantity.value *= scale->factor;
  quantity.base = scale->base;
  if (!std::isfinite(quantity.value)) {
    throw InputError(
        {"", "the number does not fit a double in SI units", fmt::format("'{}'", text), "use a smaller one"});
  }
  return quantity;
}

double parse_quantity(std::string_view text, const Dimension& wanted) {
  const Quantity quantity = parse_quantity(text);
  if (quantity.base.empty()) return quantity.value;
  const auto scale = UnitSystem::instance().scale(std::string(wanted.unit));
  if (quantity.base != scale->base) {
    throw InputError({"",
                      fmt::format("wrong dimension: {} [{}] is wanted, this is {}", wanted.name, wanted.unit,
                                  describe_dimension(quantity.base)),
                      fmt::format("'{}'", trimmed(text)),
                      fmt::format("give it in {}, or in a unit that converts to it", wanted.unit)});
  }
  return quantity.value;
}

std::string describe_dimension(const std::string& base) {
  static const std::map<std::string, std::string> kNames = [] {
    std::map<std::string, std::string> names;
    for (const Dimension& d : kDimensions) {
      names.emplace(UnitSystem::instance().scale(std::string(d.unit))->base,
                    fmt::format("{} [{}]", d.name, d.unit));
    }
    return names;
  }();
  const auto found = kNames.find(base);
  return found == kNames.end() ? fmt::format("[{}]", base) : found->second;
}

}  // namespace wishbone
