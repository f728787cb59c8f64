#include "app/tolerances.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "temporary_folder.h"

namespace wishbone {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Tolerances, LastMatchingRuleDecides) {
  Tolerances tolerances;
  tolerances.add("/tires/*=1e-3,2e-5");
  tolerances.add("*slip_angle=1e-2");
  EXPECT_EQ(tolerances.of("/tires/front/force").relative, 1e-3);
  EXPECT_EQ(tolerances.of("/tires/front/force").absolute, 2e-5);
  EXPECT_EQ(tolerances.of("/tires/front/slip_angle").relative, 1e-2);
  EXPECT_EQ(tolerances.of("/tires/front/slip_angle").absolute, 0);
  EXPECT_EQ(tolerances.of("/bodies/hub/position").relative, Tolerance().relative);
}

TEST(Tolerances, RulesInFilesKeepTheirOrder) {
  const TemporaryFolder folder;
  std::ofstream(folder / "t.yaml")
      << "\"*\": {relative: 1e-4}\n\"/tires/*\": {relative: 1e-3, absolute: 0.5}\n";
  Tolerances tolerances;
  tolerances.load(folder / "t.yaml");
  EXPECT_EQ(tolerances.of("/tires/a").absolute, 0.5);
  EXPECT_EQ(tolerances.of("/bodies/a").relative, 1e-4);
  EXPECT_EQ(tolerances.of("/bodies/a").absolute, 0);
}

TEST(Tolerances, MistakesInFilesAreShownByLine) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& yaml) -> std::string {
    std::ofstream(folder / "t.yaml") << yaml;
    try {
      Tolerances().load(folder / "t.yaml");
    } catch (const InputError& e) {
      return e.what();
    }
    return "accepted";
  };
  EXPECT_THAT(message("\"*\": {relative: 1e-4}\n\"/a\": {relativ: 1}\n"),
              AllOf(HasSubstr("t.yaml:2:8"), HasSubstr("relativ")));
  EXPECT_THAT(message("\"*\": {relative: much}\n"), AllOf(HasSubstr("t.yaml:1"), HasSubstr("much")));
  EXPECT_THAT(message("\"*\": 1e-4\n"), HasSubstr("a tolerance is a map"));
  EXPECT_THAT(message("\"*\": {relative: -1}\n"), HasSubstr("not negative"));
  EXPECT_THAT(message("- a\n- b\n"), HasSubstr("is a map from signals"));
  EXPECT_THAT(message("\"*\": {relative: 1\n"), HasSubstr("t.yaml:"));
  EXPECT_THROW(Tolerances().load(folder / "absent.yaml"), InputError);
}

TEST(Tolerances, MalformedRulesAreRefused) {
  for (const char* rule : {"", "/a", "=1", "/a=", "/a=x", "/a=1,", "/a=1,2,3", "/a=nan", "/a=-1", "/a=inf"})
    EXPECT_THROW(Tolerances().add(rule), InputError) << rule;
}

}  // namespace
}  // namespace wishbone
