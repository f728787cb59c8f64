#include "app/identification_html.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string_view>

#include "app/identification_pictures.h"
#include "app/markup.h"
#include "app/mode_text.h"
#include "app/page.h"
#include "app/text_table.h"
#include "core/error.h"

namespace wishbone {

namespace embedded {
extern const std::string_view identification_css;
extern const std::string_view identification_html;
extern const std::string_view report_css;
}  // namespace embedded

namespace {

std::string plural(Eigen::Index count, const std::string& noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

std::string support_text(const Support& support) {
  if (support.springs.empty() && support.joints.empty()) return "free";
  std::string text;
  if (!support.springs.empty()) text += plural(static_cast<Eigen::Index>(support.springs.size()), "spring");
  if (!support.joints.empty())
    text += (text.empty() ? "" : " and ") + plural(static_cast<Eigen::Index>(support.joints.size()), "joint");
  return "held by " + text;
}

std::string lead(const Identification& identification) {
  const ModalData& input = identification.input;
  const Support& found_on = identification.modes.support;
  std::string text =
      fmt::format("{} of the {}structure{}, identified from {} at {} of {}, {}",
                  plural(identification.modes.mode_count(), "mode"), found_on.empty() ? "free " : "",
                  found_on.empty() ? "" : " " + support_text(found_on), plural(input.mode_count(), "mode"),
                  plural(input.freedom_count(), "freedom"), plural(input.node_count(), "node"),
                  support_text(input.support));
  if (const auto& reference = identification.judgement.reference)
    text += "; compared with " + reference->name;
  return escape_markup(text) + ".";
}

std::string items(const std::vector<std::string>& lines) {
  std::string html;
  for (const std::string& line : lines) html += "<li>" + escape_markup(line) + "</li>\n";
  return html;
}

/// An entry of a list that may be shorter than its table.
double at(const VectorX& values, Eigen::Index i) {
  return i < values.size() ? values[i] : NAN;
}

struct Column {
  std::string header;  ///< markup
  std::function<std::string(Eigen::Index)> cell;
};

/// Columns about the reference: its mode, frequency, error, MAC.
void add_reference_columns(std::vector<Column>& columns, const ReferenceComparison& reference) {
  const auto with_partner = [&reference](auto text) {
    return [&reference, text](Eigen::Index i) {
      const Eigen::Index partner = reference.partner[i];
      return partner < 0 ? "–" : text(i, partner);
    };
  };
  columns.push_back({"Reference<small>mode</small>",
                     with_partner([](Eigen::Index, Eigen::Index k) { return fmt::format("{}", k + 1); })});
  columns.push_back({"Reference<small>Hz</small>", with_partner([&reference](Eigen::Index, Eigen::Index k) {
                       return significant_text(reference.reference_hz[k], 5);
                     })});
  columns.push_back({"Error<small>%</small>", with_partner([&reference](Eigen::Index i, Eigen::Index) {
                       return percent_text(reference.frequency_error[i]);
                     })});
  columns.push_back({"MAC<small>–</small>", with_partner([&reference](Eigen::Index i, Eigen::Index k) {
                       const double mac = reference.mac(i, k);
                       const std::string text = std::isfinite(mac) ? fmt::format("{:.4f}", mac) : "–";
                       constexpr double kGood = 0.9;
                       return mac < kGood ? "<span class=doubt>" + text + "</span>" : text;
                     })});
}

std::vector<Column> mode_columns(const Identification& identification) {
  const Judgement& judgement = identification.judgement;
  const VectorX& damping = identification.modes.damping_ratio;
  std::vector<Column> columns{{"Mode", [](Eigen::Index i) { return fmt::format("{}", i + 1); }},
                              {"Frequency<small>Hz</small>", [&](Eigen::Index i) {
                                 return significant_text(judgement.frequency_hz[i], 5);
                               }}};
  if (judgement.frequency_std_hz.size() > 0)
    columns.push_back({"Standard deviation<small>Hz</small>", [&](Eigen::Index i) {
                         return significant_text(at(judgement.frequency_std_hz, i), 2);
                       }});
  if (judgement.error_estimate.size() > 0)
    columns.push_back({"Estimated error<small>%</small>",
                       [&](Eigen::Index i) { return percent_text(at(judgement.error_estimate, i)); }});
  if (judgement.residual.size() > 0)
    columns.push_back({"Residual bound<small>%</small>", [&](Eigen::Index i) {
                         return percent_text(at(judgement.residual, i) /
                                             2);  // of omega^2: half of it is of f
                       }});
  columns.push_back(
      {"Damping &zeta;<small>%</small>", [&](Eigen::Index i) { return percent_text(at(damping, i)); }});
  if (judgement.reference) add_reference_columns(columns, *judgement.reference);
  return columns;
}

std::string mode_table(const Identification& identification) {
  const std::vector<Column> columns = mode_columns(identification);
  std::string html = "<thead><tr>";
  for (const Column& column : columns) html += "<th>" + column.header + "</th>";
  html += "</tr></thead>\n<tbody>\n";
  for (Eigen::Index i = 0; i < identification.judgement.frequency_hz.size(); ++i) {
    html += "<tr>";
    for (const Column& column : columns) html += "<td>" + column.cell(i) + "</td>";
    html += "</tr>\n";
  }
  return html + "</tbody>\n";
}

/// What the columns mean that are there.
std::string legend(const Judgement& judgement) {
  std::string text;
  if (judgement.error_estimate.size() > 0)
    text += "Estimated error: of the frequency, by what the measured set leaves open. ";
  if (judgement.residual.size() > 0)
    text += "Residual bound: how far it is at most from a frequency of the structure, by the same. ";
  if (judgement.frequency_std_hz.size() > 0)
    text += "Standard deviation: under the given measurement noise. ";
  if (judgement.reference)
    text += "Reference mode: that of the largest MAC, at least 0.4; MAC below 0.9 is red. ";
  return text.empty() ? "" : "<p class=\"caption\">" + text + "</p>";
}

std::string figure(const std::string& svg) {
  return "<figure>" + svg + "</figure>\n";
}

std::string pictures(const Identification& identification) {
  std::map<std::string, std::string> svg;
  for (const Picture& picture : identification_pictures(identification)) svg[picture.name] = picture.svg;
  const auto section = [](const std::string& heading, const std::string& body) {
    return body.empty() ? "" : "<section>\n<h2>" + heading + "</h2>\n" + body + "</section>\n\n";
  };
  const auto shown = [&](const char* name) { return svg.contains(name) ? figure(svg[name]) : ""; };
  const std::string agreement =
      shown("mac_reference.svg") + shown("mac_input.svg") + shown("mac_auto.svg") + shown("frequencies.svg");
  return section("Shapes of the lowest modes", shown("modes.svg")) +
         section("Agreement",
                 agreement.empty() ? "" : "<div class=\"grid two mac\">\n" + agreement + "</div>\n") +
         section("Lowest modes of the input", shown("input_modes.svg"));
}

/// Four digits; a dash for what is not known.
std::string measure(double value) {
  return std::isnan(value) ? "–" : std::isinf(value) ? "infinite" : brief(value);
}

std::string fact(const std::string& name, const std::string& value) {
  return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, escape_markup(value));
}

std::string quality(const Judgement& judgement) {
  return fact("Input: largest off-diagonal of normalised &Psi;<sup>T</sup>M<sub>t</sub>&Psi;",
              measure(judgement.input_orthogonality_error)) +
         fact("Result: largest element of |&Psi;<sup>T</sup>M&Psi; &minus; 1|",
              measure(judgement.orthogonality_error)) +
         fact("Result: largest element of |&Psi;<sub>0</sub><sup>T</sup>M&Psi;|",
              measure(judgement.rigid_body_error)) +
         fact("Elastic modes that this support hides", fmt::format("{}", judgement.lost_modes));
}

std::string conditions(const Judgement& judgement) {
  std::string rows;
  for (const auto& [name, value] : judgement.condition_numbers)
    rows += fact("Condition number: " + escape_markup(name), measure(value));
  return rows;
}

std::string notes(const Judgement& judgement) {
  if (judgement.notes.empty()) return "";
  return "<section>\n<h2>Notes</h2>\n<ul class=\"steps\">\n" + items(judgement.notes) + "</ul>\n</section>\n";
}

std::string provenance(const Identification& identification) {
  const auto steps = [](const std::string& heading, const ModalData& data) {
    return fmt::format("<div><h3>{}: {}</h3>\n<ol class=\"steps\">\n{}</ol></div>\n", heading,
                       escape_markup(data.title.empty() ? "untitled" : data.title), items(data.provenance));
  };
  return "<div class=\"grid two\">\n" + steps("Input", identification.input) +
         steps("Result", identification.modes) + "</div>";
}

[[noreturn]] void reject(const std::string& what, const std::string& value) {
  throw InputError({"identification page", what, value, "judge the modes that are shown"});
}

/// What the table reads; the pictures check the rest.
void check_sizes(const Identification& identification) {
  const Eigen::Index m = identification.modes.mode_count();
  if (identification.judgement.frequency_hz.size() != m)
    reject("the judgement must have a frequency for every mode",
           fmt::format("{} for {} modes", identification.judgement.frequency_hz.size(), m));
  if (!identification.judgement.reference) return;
  const ReferenceComparison& reference = *identification.judgement.reference;
  const Eigen::Index k = reference.reference_hz.size(),
                     partners = static_cast<Eigen::Index>(reference.partner.size());
  if (reference.mac.rows() != m || reference.mac.cols() != k || partners != m ||
      reference.frequency_error.size() != m)
    reject(
        "the comparison with a reference must have a row for every mode, a column for every reference mode",
        fmt::format("{} x {} MAC, {} partners, {} errors for {} and {} modes", reference.mac.rows(),
                    reference.mac.cols(), partners, reference.frequency_error.size(), m, k));
  for (const int partner : reference.partner)
    if (partner < -1 || partner >= k)
      reject(fmt::format("there are {} reference modes", k), fmt::format("mode {}", partner + 1));
}

}  // namespace

std::string identification_html(const Identification& identification) {
  check_sizes(identification);
  const Judgement& judgement = identification.judgement;
  const std::string title = identification.title.empty() ? "Identification" : identification.title;
  return filled(embedded::identification_html,
                {{"report_css", std::string(embedded::report_css)},
                 {"identification_css", std::string(embedded::identification_css)},
                 {"title", escape_markup(title)},
                 {"lead", lead(identification)},
                 {"warnings", items(judgement.warnings)},
                 {"modes", mode_table(identification)},
                 {"legend", legend(judgement)},
                 {"pictures", pictures(identification)},
                 {"quality", quality(judgement)},
                 {"conditions", conditions(judgement)},
                 {"notes", notes(judgement)},
                 {"provenance", provenance(identification)}});
}

}  // namespace wishbone
