#include "models/start.h"

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "models/compile_joints.h"
#include "models/scene_tree.h"
#include "solver/assembly.h"
#include "solver/kinematics.h"
#include "solver/pose_transfer.h"

namespace wishbone {
namespace {

/// The scene with rigid bodies, of the mass that is written, else of their nodes; with nothing pinned.
Scene rigid_scene(const Scene& scene, const SystemBuilder& builder, const System& system) {
  Scene rigid = scene;
  for (std::size_t b = 0; b < rigid.bodies.size(); ++b) {
    Scene::Body& body = rigid.bodies[b];
    const TreeBody& built = system.bodies[builder.built_index(static_cast<int>(b))];
    body.form = Scene::BodyForm::kRigid;
    if (!(body.mass > 0)) body.mass = built.mass;
    if (body.inertia.isZero(0)) body.inertia = built.J_B;
  }
  for (Scene::Joint& joint : rigid.joints) joint.cut.reset();
  return rigid;
}

/// The bodies and joints of a rigid scene, and the state that they start from.
struct Mechanism {
  SystemBuilder builder;
  System system;
  State state;
  bool guided = false;  // given positions of joints that close loops hold

  Mechanism(const Scene& rigid, bool guide) {
    JointCompiler joints(rigid, builder);
    for (const Scene::Body& body : rigid.bodies)
      builder.add_body(body.name, body.mass, body.inertia, rigid.X_WD * body.X_DB);
    joints.add_joints();
    joints.add_closures();
    if (guide)
      guided = joints.guide_positions();
    else
      joints.give_speeds();
    std::tie(system, state) = std::move(builder).build();
  }

  AssemblyReport assemble() {
    Workspace ws(system);
    return wishbone::assemble(system, state, ws, builder.given());
  }

  std::vector<RigidMotion> motions(const std::vector<int>& order) const {
    Workspace ws(system);
    update_positions<double>(system, state.t, state.q, ws);
    update_velocities<double>(system, state.t, state.q, state.v, ws);
    std::vector<RigidMotion> motions;
    for (const int i : order) motions.push_back({ws.bodies[i].X_WB, ws.bodies[i].V});
    return motions;
  }
};

bool guides(const Scene& scene) {
  const SpanningTree tree = start_tree(scene);
  for (std::size_t j = 0; j < scene.joints.size(); ++j)
    if (tree.roles[j] == JointRole::closes && !scene.joints[j].position.empty()) return true;
  return false;
}

/// The bodies of the mechanism in the order of the system.
std::vector<int> in_order_of(const SystemBuilder& builder, const Mechanism& mechanism) {
  std::vector<int> order(mechanism.system.bodies.size());
  for (std::size_t b = 0; b < order.size(); ++b)
    order[builder.built_index(static_cast<int>(b))] = mechanism.builder.built_index(static_cast<int>(b));
  return order;
}

/// Whether the mechanism moves on its closures as it should. Where it does not, and bodies deform, this is left to them: the pose
/// stays closed if it can be.
bool close(Mechanism& mechanism, bool deforms, Warnings& warnings) {
  constexpr double kContradiction = 1e-8;  // of redundant rows that motions open [m/s, rad/s]
  State last = mechanism.state;
  try {
    return mechanism.assemble().velocity_residual <= kContradiction;
  } catch (const OpenClosures&) {
    if (!deforms) throw;
  } catch (const InputError& error) {
    if (!deforms) throw;
    warnings.push_back(error.diagnostic());
    warnings.back().remedy = "the flexible bodies start deforming; " + warnings.back().remedy;
  }
  mechanism.state = last;
  return false;
}

}  // namespace

void set_start(const Scene& scene, const SystemBuilder& builder, const System& system, State& initial,
               Warnings& warnings) {
  const bool guided = guides(scene);
  if (!guided && scene_tree(scene).roles == start_tree(scene).roles) return;  // starts as it is
  const Scene rigid = rigid_scene(scene, builder, system);
  VectorX q;
  if (guided) {
    Mechanism mechanism(rigid, true);
    mechanism.assemble();
    q = mechanism.state.q;
  }
  Mechanism mechanism(rigid, false);
  if (guided) mechanism.state.q = q;
  const bool moves = close(mechanism, !system.flexible.empty(), warnings);
  const VectorX v = initial.v;
  Workspace ws(system);
  set_rigid_motions(system, mechanism.motions(in_order_of(builder, mechanism)), initial, ws);
  if (!moves) initial.v = v;
}

}  // namespace wishbone
