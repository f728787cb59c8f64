#include "solver/random/simbody_exchange.h"

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <string>

#include "temporary_folder.h"

namespace wishbone::testing {
namespace {

using Json = nlohmann::json;

constexpr const char* kProgram = WISHBONE_SIMBODY_REFERENCE;

Json json_of(const Vector3& v) {
  return {v.x(), v.y(), v.z()};
}
Json json_of(const Vector6& V) {
  return {json_of(Vector3(angular(V))), json_of(Vector3(linear(V)))};
}
Json json_of(const Matrix3& M) {
  Json rows;
  for (int i = 0; i < 9; ++i) rows.push_back(M(i / 3, i % 3));
  return rows;
}
Json json_of(const Pose& X) {
  return {{"R", json_of(X.R)}, {"p", json_of(X.p)}};
}

Vector3 vector_of(const Json& json) {
  return Vector3(json[0], json[1], json[2]);
}
Pose pose_of(const Json& json) {
  Pose X;
  for (int i = 0; i < 9; ++i) X.R(i / 3, i % 3) = json.at("R")[static_cast<std::size_t>(i)];
  X.p = vector_of(json.at("p"));
  return X;
}
std::vector<Vector6> spatials_of(const Json& json) {
  std::vector<Vector6> all;
  for (const Json& V : json) all.push_back(spatial(vector_of(V[0]), vector_of(V[1])));
  return all;
}
BodyMotions motions_of(const Json& json) {
  BodyMotions motions;
  for (const Json& X : json.at("poses")) motions.poses.push_back(pose_of(X));
  motions.velocities = spatials_of(json.at("velocities"));
  return motions;
}

Json json_of(const Mechanism& m) {
  Json json{{"gravity", json_of(m.gravity)},
            {"bodies", Json::array()},
            {"joints", Json::array()},
            {"closures", Json::array()},
            {"springs", Json::array()}};
  for (const auto& b : m.bodies)
    json["bodies"].push_back({{"mass", b.mass}, {"inertia", json_of(b.J_B)}, {"pose", json_of(b.X_WB)}});
  for (const auto& j : m.joints)
    json["joints"].push_back({{"kind", info(j.kind).name},
                              {"parent", j.parent},
                              {"reversed", j.reversed},
                              {"pose", json_of(j.X_WJ)},
                              {"pitch", j.pitch}});
  for (const auto& c : m.closures)
    json["closures"].push_back({{"kind", joint_kind(c.joint)},
                                {"bodies", {c.A, c.B}},
                                {"pose", json_of(c.X_WA)},
                                {"other_point", json_of(c.p_WB)}});
  for (const auto& s : m.springs)
    json["springs"].push_back({{"bodies", {s.P, s.Q}},
                               {"points", {json_of(s.p_WP), json_of(s.p_WQ)}},
                               {"stiffness", s.stiffness},
                               {"damping", s.damping},
                               {"free_length", s.free_length}});
  return json;
}

std::string text_of(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

}  // namespace

bool simbody_is_installed() {
  return *kProgram != '\0';
}

SimbodyAnswer ask_simbody(const Mechanism& mechanism, const BodyMotions& start, double duration,
                          double accuracy) {
  Json question = json_of(mechanism);
  question["duration"] = duration;
  question["accuracy"] = accuracy;
  for (const Pose& X : start.poses) question["poses"].push_back(json_of(X));
  for (const Vector6& V : start.velocities) question["velocities"].push_back(json_of(V));

  const TemporaryFolder folder;
  const std::string in = folder / "question.json", out = folder / "answer.json", err = folder / "errors";
  std::ofstream(in) << question.dump();
  const std::string command = std::string(kProgram) + " < " + in + " > " + out + " 2> " + err;
  if (std::system(command.c_str()) != 0) throw std::runtime_error("simbody_reference: " + text_of(err));

  const Json answer = Json::parse(text_of(out));
  const Json& now = answer.at("start");
  return {motions_of(now), motions_of(answer.at("end")), spatials_of(now.at("accelerations")),
          spatials_of(now.at("joint_reactions")), spatials_of(now.at("closure_reactions"))};
}

}  // namespace wishbone::testing
