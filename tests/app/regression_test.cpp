#include "app/regression.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "app/junit.h"
#include "app/small_run.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

using testing::HasSubstr;

class RegressionTest : public testing::Test {
 protected:
  std::vector<Verdict> check_runs(const SmallRun& fresh, const SmallRun& base,
                                  const Tolerances& tolerances = {}) {
    return check(ResultFile(fresh.write(folder_ / "fresh.h5")), ResultFile(base.write(folder_ / "base.h5")),
                 tolerances);
  }
  /// Messages of what failed, signal first.
  static std::vector<std::string> failures(const std::vector<Verdict>& verdicts) {
    std::vector<std::string> found;
    for (const Verdict& v : verdicts)
      if (!v.passed) found.push_back(v.signal + ": " + v.message);
    return found;
  }
  TemporaryFolder folder_;
};

using testing::ElementsAre;
using testing::IsEmpty;

TEST_F(RegressionTest, EqualRunsPass) {
  EXPECT_THAT(failures(check_runs({}, {})), IsEmpty());
}

// max |base| = 4, so 0.125 * 4 + 0.25 = 0.75 is allowed: exactly representable, hence sharp.
TEST_F(RegressionTest, ToleranceIsMetAtItsEdgeAndMissedBeyond) {
  Tolerances tolerances;
  tolerances.add("*=0.125,0.25");
  SmallRun edge;
  edge.scalar = [](double t) { return t == 2 ? 2.75 : t; };
  EXPECT_THAT(failures(check_runs(edge, {}, tolerances)), IsEmpty());
  SmallRun beyond;
  beyond.scalar = [](double t) { return t == 2 ? std::nextafter(2.75, 3) : t; };
  EXPECT_THAT(failures(check_runs(beyond, {}, tolerances)), ElementsAre(HasSubstr("/group/scalar: differs")));
}

// The vector is (100, t, 0): a deviation of 0.5 in the zero component is 0.5 % of the signal.
TEST_F(RegressionTest, SmallComponentsAreMeasuredAgainstTheWholeVector) {
  SmallRun fresh;
  fresh.vector = [](double t) { return std::vector<double>{100, t, t == 3 ? 0.5 : 0}; };
  Tolerances coarse;
  coarse.add("*=0.006");
  EXPECT_THAT(failures(check_runs(fresh, {}, coarse)), IsEmpty());
  Tolerances fine;
  fine.add("*=0.004");
  EXPECT_THAT(failures(check_runs(fresh, {}, fine)),
              ElementsAre(HasSubstr("/group/vector: z differs by 0.5 N at 3 s")));
}

TEST_F(RegressionTest, BaseMayBeCoarserAndPoorer) {
  SmallRun base;
  base.times = {0, 2, 4};
  EXPECT_THAT(failures(check_runs({}, base)), IsEmpty());
  SmallRun wrong;
  wrong.scalar = [](double t) { return t == 2 ? 9 : t; };
  EXPECT_EQ(failures(check_runs(wrong, base)).size(), 1u);
}

TEST_F(RegressionTest, InstantsThatAreNotRecordedFailInsteadOfBeingInterpolated) {
  SmallRun base;
  base.times = {0, 1.5, 4};
  EXPECT_THAT(
      failures(check_runs({}, base)),
      ElementsAre(HasSubstr("/time: the new file has no row at 1.5 s"),
                  HasSubstr("/group/scalar: not compared"), HasSubstr("/group/vector: not compared")));
}

TEST_F(RegressionTest, RunsOfOtherLengthFail) {
  SmallRun shorter;
  shorter.times = {0, 1, 2};
  EXPECT_THAT(failures(check_runs(shorter, {})).front(),
              HasSubstr("/time: the new run ends at 2 s, the base at 4 s"));
  EXPECT_THAT(failures(check_runs({}, shorter)).front(),
              HasSubstr("/time: the new run ends at 4 s, the base at 2 s"));
}

TEST_F(RegressionTest, MissingSignalsOtherUnitsNanAndIncompleteRunsFail) {
  SmallRun renamed;
  renamed.scalar_path = "/group/renamed";
  EXPECT_THAT(failures(check_runs(renamed, {})), ElementsAre("/group/scalar: missing from the new file"));
  SmallRun millimetres;
  millimetres.units = "mm";
  EXPECT_THAT(failures(check_runs(millimetres, {})), ElementsAre(HasSubstr("unit 'mm'")));
  SmallRun nan;
  nan.scalar = [](double t) { return t == 3 ? NAN : t; };
  EXPECT_THAT(failures(check_runs(nan, {})), ElementsAre("/group/scalar: not finite at 3 s"));
  EXPECT_THAT(failures(check_runs({}, nan)), ElementsAre("/group/scalar: the base is not finite at 3 s"));
  SmallRun cut;
  cut.outcome = Outcome::kFailed;
  EXPECT_THAT(failures(check_runs(cut, {})),
              ElementsAre("/meta/status: the run is not complete: failed: on purpose"));
}

TEST_F(RegressionTest, JunitIsWellFormedXmlWithOneCaseASignal) {
  std::vector<Verdict> verdicts(3);
  verdicts[0].signal = "/a<b>&\"c\"";
  verdicts[1] = {"/bad", false, "unit '<1>' & \"more\"\n", 1, 0, 0};
  verdicts[2].signal = "/fine";
  const std::string path = folder_ / "junit.xml";
  std::ofstream(path) << junit_xml("new.h5 against base.h5", verdicts);
  const std::string python =
      "python3 -c \"import sys, xml.etree.ElementTree as E; r = E.parse(sys.argv[1]).getroot(); "
      "sys.exit(not (len(r.findall('.//testcase')) == 3 and len(r.findall('.//failure')) == 1 and "
      "r.get('failures') == '1' and r.find('.//testcase').get('name') == '/a<b>&\\\"c\\\"'))\" ";
  EXPECT_EQ(std::system((python + path).c_str()), 0);
}

}  // namespace
}  // namespace wishbone
