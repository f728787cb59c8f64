#include "app/identification_html.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <set>

#include "app/identification_pictures.h"
#include "app/synthetic_identification.h"
#include "app/xml.h"
#include "core/error.h"

namespace wishbone {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

/// True when every element of a page is closed in its turn, as a parser that is not ours sees it.
bool closes_its_elements(const std::string& page) {
  const TemporaryFolder folder;
  std::ofstream(folder / "page.html", std::ios::binary) << page;
  std::ofstream(folder / "check.py") << R"(
import sys
from html.parser import HTMLParser
class Check(HTMLParser):
    open = []
    def handle_starttag(self, tag, attributes):
        if tag not in ("meta", "br", "hr"): self.open.append(tag)
    def handle_startendtag(self, tag, attributes): pass
    def handle_endtag(self, tag):
        if self.open.pop() != tag: sys.exit(1)
check = Check()
check.feed(open(sys.argv[1], encoding="utf-8").read())
sys.exit(len(check.open) != 0)
)";
  return std::system(("python3 " + (folder / "check.py") + " " + (folder / "page.html")).c_str()) == 0;
}

std::vector<std::string> names_of(const std::vector<Picture>& pictures) {
  std::vector<std::string> names;
  for (const Picture& picture : pictures) names.push_back(picture.name);
  return names;
}

TEST(IdentificationHtml, ShowsWhatWasIdentifiedFromWhatAndHowGoodItIs) {
  Identification identification = chassis_identification(8);
  identification.judgement.lost_modes = 3;
  identification.judgement.reference->partner[4] = -1;
  identification.judgement.reference->frequency_error[4] = NAN;
  const std::string page = identification_html(identification);
  for (const char* shown :
       {"8 modes of the free structure, identified from 8 modes at 60 freedoms of 20 nodes, held by 4 "
        "springs",
        "compared with finite elements", "<li>mode 2 &amp; 3 are close</li>",
        "<td>1</td><td>17.371</td><td>0.035</td><td>0.61</td><td>1.20</td><td>1</td><td>17.353</td><td>0.10</"
        "td>",
        "<td>–</td><td>–</td><td>–</td><td>–</td></tr>", "scaled the modes to unit modal mass",
        "Condition number: Psi^T M Psi</th><td>1.02</td>", "this support hides</th><td>3</td>",
        "block of hexahedra", "MAC against finite elements", "Frequency error against finite elements"})
    EXPECT_THAT(page, HasSubstr(shown));
  EXPECT_EQ(count_of("<svg", page), 6u);
  EXPECT_FALSE(shows_nan(page));
  EXPECT_EQ(page, identification_html(identification));
}

TEST(IdentificationHtml, SaysWhatTheIdentifiedModesAreHeldBy) {
  Identification identification = chassis_identification(3);
  identification.modes.support.joints = {{1, Vector3::UnitZ()}};
  EXPECT_THAT(identification_html(identification),
              HasSubstr("3 modes of the structure held by 1 joint, identified from"));
}

TEST(IdentificationHtml, EscapesEveryTextOfTheUser) {
  Identification identification = chassis_identification(3);
  const std::string evil = "</title><script>alert(1)</script>";
  identification.title = identification.input.title = identification.modes.title = evil;
  identification.judgement.warnings = identification.judgement.notes = {evil};
  identification.judgement.condition_numbers = {{evil, INFINITY}};
  identification.judgement.reference->name = evil;
  identification.input.provenance = identification.modes.provenance = {evil};
  const std::string page = identification_html(identification);
  EXPECT_THAT(page, Not(HasSubstr("<script")));
  EXPECT_THAT(page, HasSubstr("&lt;/title&gt;&lt;script&gt;"));
  EXPECT_TRUE(closes_its_elements(page));
}

TEST(IdentificationHtml, LoadsNothing) {
  const std::string page = identification_html(chassis_identification(3));
  for (const char* loads : {"<link", "<img", "<iframe", "<script", "@import", "url(", "href"})
    EXPECT_THAT(page, Not(HasSubstr(loads)));
  EXPECT_THAT(page, HasSubstr("Content-Security-Policy\" content=\"default-src 'none'; "));
}

TEST(IdentificationHtml, LeavesOutWhatIsNotKnown) {
  Identification identification = chassis_identification(3);
  Judgement& judgement = identification.judgement;
  judgement.reference.reset();
  judgement.frequency_std_hz.resize(0);
  judgement.residual.resize(0);
  judgement.input_mac.resize(0, 0);
  judgement.orthogonality_error = NAN;
  judgement.notes.clear();
  identification.input.support = {};
  const std::string page = identification_html(identification);
  for (const char* absent :
       {"Reference", "Standard deviation", "Residual", "<h2>Notes", "compared", "frequency error"})
    EXPECT_THAT(page, Not(HasSubstr(absent)));
  EXPECT_THAT(page, HasSubstr("20 nodes, free."));
  EXPECT_FALSE(shows_nan(page));
  EXPECT_TRUE(closes_its_elements(page));
  EXPECT_THAT(names_of(identification_pictures(identification)),
              UnorderedElementsAre("modes.svg", "input_modes.svg", "mac_auto.svg"));
}

TEST(IdentificationHtml, OfNothingIsAPage) {
  const std::string page = identification_html({});
  EXPECT_TRUE(closes_its_elements(page));
  EXPECT_EQ(count_of("<svg", page), 0u);
}

TEST(IdentificationHtml, RefusesAJudgementOfOtherModes) {
  const Identification good = chassis_identification(4);
  const auto refused = [&](auto spoil) {
    Identification bad = good;
    spoil(bad.judgement);
    EXPECT_THROW(identification_html(bad), InputError);
  };
  refused([](Judgement& j) { j.frequency_hz.conservativeResize(3); });
  refused([](Judgement& j) { j.reference->mac.conservativeResize(4, 3); });
  refused([](Judgement& j) { j.reference->partner.pop_back(); });
  refused([](Judgement& j) { j.reference->partner[0] = 4; });
  refused([](Judgement& j) { j.reference->frequency_error.conservativeResize(5); });
  refused([](Judgement& j) { j.input_mac.conservativeResize(4, 2); });
  refused([](Judgement& j) { j.auto_mac.conservativeResize(2, 2); });
}

TEST(IdentificationPictures, AreWrittenIntoAFolder) {
  const TemporaryFolder folder;
  const Identification identification = chassis_identification(4);
  write_pictures(folder / "deep/pictures", identification);
  const std::set<std::string> expected{"modes.svg",       "input_modes.svg", "mac_reference.svg",
                                       "frequencies.svg", "mac_input.svg",   "mac_auto.svg"};
  std::set<std::string> found;
  for (const auto& file : std::filesystem::directory_iterator(folder / "deep/pictures")) {
    found.insert(file.path().filename());
    std::ifstream text(file.path());
    EXPECT_TRUE(is_well_formed_xml((std::ostringstream() << text.rdbuf()).str())) << file.path();
  }
  EXPECT_EQ(found, expected);
  std::ofstream(folder / "file") << "in the way";
  EXPECT_THROW(write_pictures(folder / "file", identification), NumericsError);
}

}  // namespace
}  // namespace wishbone
