#pragma once

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bodies/rayleigh_damping.h"
#include "core/error.h"
#include "core/function.h"
#include "core/source.h"
#include "core/spatial.h"
#include "identification/elements/reference_element.h"
#include "identification/mode_choice.h"
#include "joints/joint_kind.h"
#include "solver/flexible_signal.h"

namespace wishbone {

struct AnalyticalModel;
struct IdentificationTask;

/// What the user wrote, checked and in SI units; no behaviour. Everything is described in the design pose and
/// in one design frame D, which `X_WD` places in the inertial frame W. Bodies, joints, ... refer to one
/// another by index.
struct Scene {
  static constexpr int kGround = -1;

  /// A point where a joint or force takes hold.
  struct Point {
    int body = kGround;              ///< index into `bodies`, or kGround
    int node = 0;                    ///< id of a node of the body; 0: none was named
    Vector3 p_DP = Vector3::Zero();  ///< position in D [m]; that of the node when one was named
    int frame = -1;  ///< index into the frames of the body that carries it; -1: none was named
  };

  /// A rectangular block of hexahedra, centred at the body origin, edges along the body axes.
  struct Block {
    Vector3 size = Vector3::Zero();     ///< edge lengths [m]
    Eigen::Vector3i elements{1, 1, 1};  ///< number of elements along each edge
    double young = 0;                   ///< Young's modulus [Pa]
    double poisson = 0;                 ///< Poisson's ratio
    double density = 0;                 ///< [kg/m3]
    ElementType type = ElementType::incompatible_modes;
  };

  /// How the axes of a flexible body follow it: mean axes, or fixed on three of its nodes.
  using FixedAxes = std::array<int, 3>;

  /// Nodes that static shapes are taken at.
  struct StaticNodes {
    bool interfaces = false;  ///< those that joints, closures, springs and loads take hold of
    std::vector<int> ids;     ///< or these

    bool empty() const { return !interfaces && ids.empty(); }
  };

  /// A frame over several nodes of a body, which follows them in the mean, or to which they are tied.
  struct Frame {
    std::string name;
    std::vector<int> nodes;
    std::vector<double> weights;  ///< of each node; empty: all one
    bool rigid = false;           ///< the nodes keep their distances
    Vector3 centre_B =
        Vector3::Zero();  ///< weighted centre of the nodes, body axes, from the mass centre [m]
  };

  /// Geometric stiffening by spin about `centre_D` of a body held at nodes.
  struct Stiffening {
    std::vector<int> held;            ///< nodes; none: free
    std::optional<Vector3> centre_D;  ///< [m]; by default that of the held nodes
  };

  /// Nodes of a body and where its elastic modes come from: a block, a model, or an identification.
  struct Flexible {
    std::vector<int> node_ids;
    Matrix3X node_position;  ///< 3 x n, body axes, from the mass centre [m]
    std::optional<Block> block;
    std::shared_ptr<const AnalyticalModel> model;              ///< instead of a block; masses are lumped
    std::shared_ptr<const IdentificationTask> identification;  ///< null: modes of the block or model
    bool is_rigid = false;                                     ///< no modes at all
    ModeChoice modes;  ///< normal modes kept of those of the block or model
    NormalModes modes_of = NormalModes::of_free_body;
    bool automatic = false;              ///< `modes` and `attachment` are the program's choice
    StaticNodes attachment, constraint;  ///< beside normal modes
    std::vector<double> damping;  ///< damping ratio of each kept mode; empty: as identified, or one for all
    /// One damping ratio for all modes, when their number is not known yet.
    std::optional<double> common_damping;
    std::optional<RayleighDamping> rayleigh;  ///< instead of damping ratios
    std::optional<FixedAxes> fixed_axes;      ///< node ids; empty: mean axes
    bool source_terms = false;                ///< inertial coupling as in the source, not all that there is
    std::vector<Frame> frames;
    std::optional<Stiffening> stiffening;
  };

  enum class BodyForm { kRigid, kModal, kNodal };
  struct Body {
    std::string name;
    BodyForm form = BodyForm::kRigid;
    double mass = 0;  ///< [kg]; of a flexible body: as written, unused (its nodes have their own)
    Matrix3 inertia = Matrix3::Zero();  ///< about the mass centre, body axes [kg m2]; flexible: as for `mass`
    Pose X_DB;                          ///< design pose; Bo is the mass centre [m]
    std::optional<Vector3> v_WBo;       ///< initial velocity, inertial axes [m/s]
    std::optional<Vector3> w_WB_B;      ///< initial angular velocity, body axes [rad/s]
    std::optional<Flexible> flexible;   ///< always there unless rigid; gives a rigid body its nodes
    Source where;

    bool is_flexible() const { return form != BodyForm::kRigid; }
  };

  /// Force laws on one coordinate of a joint [rad or m].
  struct CoordinateSpring {
    int coordinate = 0;
    double stiffness = 0, damping = 0;  ///< [N m/rad, N m s/rad] or [N/m, N s/m]
    double free = 0;                    ///< where it is relaxed
  };
  struct CoordinateFriction {
    int coordinate = 0;
    double coulomb = 0, viscous = 0;  ///< [N m, N m s/rad] or [N, N s/m]
    double smoothing = 0;             ///< rate at which dry friction has reached tanh 1 of its value
    std::optional<double> peak;       ///< friction at rest, at least `coulomb`
    double peak_rate = 0;             ///< rate over which the peak falls off
  };
  struct CoordinateLimit {
    int coordinate = 0;
    std::optional<double> lower, upper;
    double stiffness = 0;  ///< [N m/rad^n] or [N/m^n]
    double exponent = 1.5;
    double damping = 0;  ///< [s/rad] or [s/m]
  };

  /// Joins a first-named and a second-named body. It carries one of them or closes a loop. At zero coordinates the bodies
  /// are in their design poses; positive ones turn or slide the second along the axes.
  struct Joint {
    std::string name;
    JointKind kind = JointKind::fixed;
    std::optional<bool> cut;  ///< whether it closes a loop; empty: the program chooses
    Point first, second;      ///< coincident in the design pose
    /// Axes of the joint (joints/joint_kind.h); identity where it has none.
    Matrix3 R_DJ = Matrix3::Identity();
    double pitch = 0;  ///< of a screw [m/rad]
    /// Initial coordinates and speeds that are given; empty: none.
    std::vector<std::optional<double>> position, speed;
    std::optional<Vector3> spin;  ///< of a spherical one, w_12 in axes of the second body [rad/s]
    std::vector<int> motion;      ///< of each coordinate, index into `motions` or -1; empty: none
    double weight = 1;  ///< factor on its share of the metric in which the initial pose is assembled
    std::vector<CoordinateSpring> springs;
    std::vector<CoordinateFriction> frictions;
    std::vector<CoordinateLimit> limits;
    Source where;

    /// Whether it has initial values of its own.
    bool starts() const { return !position.empty() || !speed.empty() || spin.has_value(); }
  };

  /// A coordinate of a joint, as couplings and signals refer to it.
  struct JointCoordinate {
    int joint = -1;
    int coordinate = 0;
  };
  enum class ClosureType { kDistance, kPointOnLine, kPointOnPlane, kCoupling };
  /// What binds bodies but carries none.
  struct Closure {
    std::string name;
    ClosureType type = ClosureType::kDistance;
    Point from, to;
    Vector3 direction_D = Vector3::UnitZ();  ///< of the line, normal of the plane; fixed to `from`
    std::optional<double> length;            ///< of a distance [m]; empty: as in the design pose
    int motion = -1;                         ///< that a distance follows, index into `motions`
    struct Term {
      JointCoordinate of;
      double factor = 1;
    };
    std::vector<Term> terms;  ///< of a coupling: sum factor u = constant
    double constant = 0;
    Source where;
  };

  /// Point-to-point spring and damper in parallel.
  struct Spring {
    std::string name;
    Point from, to;
    double stiffness = 0;    ///< [N/m]
    double damping = 0;      ///< [N s/m]
    double free_length = 0;  ///< [m]
    Source where;
  };

  enum class SignalType { kCoordinate, kDistance, kComponent };
  /// A scalar of the motion that functions may use by name: the coordinate of a joint, the distance of two
  /// points, or a component of a point's position in inertial axes; or the speed of one of these.
  struct Signal {
    std::string name;
    SignalType type = SignalType::kCoordinate;
    JointCoordinate of;  ///< of a coordinate
    Point from, to;      ///< of a distance; a component is that of `from`
    int axis = 0;        ///< of a component: 0 x, 1 y, 2 z
    bool is_speed = false;
    Source where;
  };

  /// Force at a point and moment: components are functions of the time and the signals.
  struct Load {
    std::string name;
    Point point;                     ///< the mass centre unless named
    std::array<Function, 3> force;   ///< [N]
    std::array<Function, 3> moment;  ///< [N m]
    bool in_body_axes = false;       ///< otherwise inertial axes
    Source where;
  };

  /// Force or moment along the coordinate of a joint, > 0 pushes it to grow: a function of the time and the signals.
  struct Drive {
    std::string name;
    JointCoordinate along;
    Function force;  ///< [N m] or [N]
    Source where;
  };

  enum class TireForm { kSmooth, kClassic };
  /// Parameters of the UA tire.
  struct TireModel {
    std::string name;
    TireForm form = TireForm::kSmooth;
    double radius = 0;                   ///< unloaded, R1 [m]
    double vertical_stiffness = 0;       ///< Cz [N/m]
    double damping_ratio = 0;            ///< zeta of the vertical damping
    double mass = 0;                     ///< mt, which sets the vertical damping [kg]
    double slip_stiffness = 0;           ///< Cs, force per slip ratio [N]
    double cornering_stiffness = 0;      ///< C_alpha, force per slip angle [N/rad]
    double camber_stiffness = 0;         ///< C_gamma, force per camber angle [N/rad]
    double rolling_resistance = 0;       ///< Kr, moment per load [m]
    double friction_max = 0;             ///< U0, at zero slip
    double friction_min = 0;             ///< U1, at full slip
    bool lag = false;                    ///< slips follow with the relaxation lengths
    double relaxation_longitudinal = 0;  ///< sigma_kappa [m]; positive when `lag`
    double relaxation_lateral = 0;       ///< sigma_alpha [m]; positive when `lag`
    Source where;
  };
  /// A tire on a rigid body whose y axis is the spin axis and whose origin is the wheel centre.
  struct Tire {
    std::string name;
    int wheel = kGround;  ///< index into `bodies`
    int model = -1;       ///< index into `tire_models`
    Source where;
  };

  /// Height -depth sin(pi (x - start)/length) while start <= x <= start + length.
  struct Depression {
    double start = 0;   ///< [m]
    double length = 0;  ///< [m]
    double depth = 0;   ///< [m]; negative: a hump
  };
  /// Road of height y tan(bank) + depression, inertial axes.
  struct Road {
    double bank = 0;  ///< [rad]
    std::optional<Depression> depression;
    Source where;
  };

  enum class Side { kLeft, kRight };
  /// tan(wheel) = l tan(command) / (l -+ (w/2) tan(command)), minus on the left.
  struct Ackermann {
    double wheelbase = 0;  ///< l [m]
    double track = 0;      ///< w [m]
    Side side = Side::kLeft;
  };
  /// `change` s((t - time)/duration), s(u) = 6 u^5 - 15 u^4 + 10 u^3 between 0 and 1.
  struct MotionStep {
    double time = 0;      ///< [s]
    double duration = 0;  ///< [s]
    double change = 0;    ///< [rad] or [m]
  };
  /// Prescribed joint coordinate: `start` plus the sum of the steps, or a function of the time; then the
  /// Ackermann map if there is one.
  struct Motion {
    std::string name;
    double start = 0;  ///< [rad] or [m]
    std::vector<MotionStep> steps;
    std::optional<Function> law;  ///< instead of start and steps
    std::optional<Ackermann> ackermann;
    Source where;
  };

  struct SteeringAngle {
    std::string name;
    int joint = -1;  ///< index into `joints`: a revolute tree joint
  };
  /// Which body and joints the derived vehicle signals are made of.
  struct Vehicle {
    int chassis = kGround;
    std::vector<SteeringAngle> steering;
    Source where;
  };

  enum class Form { kAuto, kOde, kIndex1, kPartition, kGgl };
  enum class Integrator { kAuto, kAdams, kBdf, kErk };
  struct Analysis {
    double duration = 1;  ///< [s]
    Form form = Form::kAuto;
    Integrator integrator = Integrator::kAuto;
    double rtol = 1e-6;              ///< relative tolerance
    double atol = 1e-8;              ///< absolute tolerance [m, rad, m/s, rad/s]
    std::optional<double> max_step;  ///< [s]
    std::optional<int> max_steps;    ///< of the integrator, in the whole run
    Source where;
  };

  /// What is recorded of a body that may be flexible beside its modal coordinates; nothing while it is rigid.
  struct FlexibleOutput {
    int body = kGround;
    std::vector<int> nodes;  ///< whose deflections are recorded
    std::set<FlexibleSignal> signals;
  };
  /// Quantities that a matrix makes of the modal coordinates of a body, one each row: stresses, strains.
  struct RecoveryOutput {
    std::string name;
    int body = kGround;
    std::string unit;               ///< of the quantities, as written
    std::vector<std::string> rows;  ///< names of the rows: numbers from 1 where the file gives none
    MatrixX matrix;                 ///< chosen rows x modes
    Source where;                   ///< of the file's name
  };
  /// A point of a body whose motion is recorded.
  struct PointOutput {
    std::string name;
    Point point;
  };
  struct Output {
    double interval = 0.01;  ///< [s]; by default the whole run when that is shorter
    std::vector<FlexibleOutput> flexible;
    std::vector<RecoveryOutput> recoveries;
    std::vector<PointOutput> points;
    std::vector<std::string> record;  ///< patterns of the paths of signals that are recorded; none: all
    Source where;
  };

  Warnings warnings;                    ///< what was read without error but may not be what was meant
  std::vector<std::string> data_files;  ///< that identifications and tables read
  std::string title;
  std::string text;  ///< the resolved document as YAML; loading it gives the same scene
  std::map<std::string, double>
      parameters;                ///< those that are numbers or truth values, in SI: for expressions
  Vector3 gravity{0, 0, -9.81};  ///< inertial axes [m/s2]
  Pose X_WD;                     ///< placement of the design frame
  std::vector<Body> bodies;
  std::vector<Joint> joints;
  std::vector<Closure> closures;
  std::vector<Spring> springs;
  std::vector<Signal> signals;
  std::vector<Load> loads;
  std::vector<Drive> drives;
  std::vector<TireModel> tire_models;
  std::vector<Tire> tires;
  std::optional<Road> road;  ///< always there when there are tires
  std::vector<Motion> motions;
  std::optional<Vehicle> vehicle;
  Analysis analysis;
  Output output;
};

}  // namespace wishbone
