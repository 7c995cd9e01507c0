// SPDX-License-Identifier: MIT
// From a rig's bind pose and clips to the frames P and C of each joint model.
//
// Directions go between spaces as polar vectors (bones, where flexion leads, the side of the palm),
// by the full matrices; an axis of rotation is only ever taken as a cross product inside the space
// where it is used. So scale and mirrors above the limb do no harm.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/body_axes.h"
#include "core/anatomy/flexion_axis.h"
#include "core/anatomy/limb_model.h"
#include "core/anatomy/limits.h"

namespace elbowroom {
namespace {

constexpr double kDegree = kPi / 180.0;
// A hinge or swing whose residual exceeds these over the clips is not what the rig does: the joint
// becomes a ball. Stricter than what a good fit is asked for (5° and 15°), since other clips of the
// rig will come.
constexpr double kMedianResidual = 3.5 * kDegree;
constexpr double kHighResidual = 11 * kDegree;
// Bound farther than this from palms down, the palm's side is taken from the fingers.
constexpr double kPalmTurned = 45 * kDegree;
constexpr double kSampleRate = 30;  // Hz, of the clips
constexpr int kSamplesPerClip = 600;

// The axes in which a joint's local rotation lives: its parent's.
struct ParentSpace {
  Mat3 world_from_parent{1.0};
  Mat3 parent_from_world{1.0};
  double mirror = 1;  // -1 if the parent's axes are left-handed in the world

  std::optional<Vec3> from_world(const Vec3& v) const { return direction(parent_from_world * v); }
  std::optional<Vec3> to_world(const Vec3& v) const { return direction(world_from_parent * v); }
};

struct Rig {
  const BoundFigure& figure;
  const Model& model;
  const Character& character;
  const Limb& limb;
  const std::vector<Mat4>& globals;
  BodyAxes body;
  Vec3 outward;  // world
  double side;   // +1 on the body's left

  const Joint& joint(int index) const {
    return model.skeleton.joints[static_cast<std::size_t>(index)];
  }
  std::string where(int index) const {
    return model.path.filename().string() + ", joint '" + joint(index).name + "'";
  }
};

std::optional<ParentSpace> parent_space(const Rig& rig, int joint) {
  ParentSpace space;
  const int parent = rig.joint(joint).parent;
  if (parent < 0) return space;
  space.world_from_parent = Mat3(rig.globals[static_cast<std::size_t>(parent)]);
  // Scale to unit size, so that the tests below are about shape.
  const double size = std::cbrt(std::abs(glm::determinant(space.world_from_parent)));
  if (!(size > 0) || !std::isfinite(size)) return std::nullopt;
  space.world_from_parent /= size;
  space.parent_from_world = glm::inverse(space.world_from_parent);
  for (int c = 0; c < 3; ++c) {
    if (!finite(space.parent_from_world[c])) return std::nullopt;
  }
  space.mirror = glm::determinant(space.world_from_parent) < 0 ? -1 : 1;
  return space;
}

// The rotation R of the joint's local transform T · R · S at the bind pose.
Quat bound_rotation(const Rig& rig, int joint) {
  const int parent = rig.joint(joint).parent;
  Mat4 local = rig.globals[static_cast<std::size_t>(joint)];
  if (parent >= 0) local = glm::inverse(rig.globals[static_cast<std::size_t>(parent)]) * local;
  // A mirror in the joint's own scale is the node's, not the rotation's.
  const Vec3& scale = rig.joint(joint).rest.scale;
  for (int c = 0; c < 3; ++c) {
    if (scale[c] < 0) local[c] = -local[c];
  }
  return rotation_of(local);
}

// Local rotations of a joint over all clips of the file, at a regular rate.
std::vector<Quat> clip_rotations(const Model& model, int joint) {
  std::vector<Quat> rotations;
  for (const Clip& clip : model.clips) {
    const int channel = clip.find_channel(joint, Path::rotation);
    const double duration = clip.duration();
    if (channel < 0 || !(duration >= 0) || !std::isfinite(duration)) continue;
    const int count =
        1 + std::min(kSamplesPerClip - 1, static_cast<int>(std::min(1e6, duration * kSampleRate)));
    for (int i = 0; i < count; ++i) {
      const double t = clip.begin + (count > 1 ? duration * i / (count - 1) : 0.0);
      const Quat q = sample_rotation(clip.channels[static_cast<std::size_t>(channel)], t);
      if (std::isfinite(q.w + q.x + q.y + q.z)) rotations.push_back(q);
    }
  }
  return rotations;
}

struct ResidualSize {
  double median = 0, high = 0;  // 50th and 99th percentile, radians
};

ResidualSize residual_size(const JointModel& joint, const std::vector<Quat>& rotations) {
  std::vector<double> angles;
  for (const Quat& rotation : rotations) {
    double q[3];
    Quat residual;
    decompose(joint, rotation, q, residual);
    angles.push_back(glm::length(rotation_vector_from_quat(residual)));
  }
  if (angles.empty()) return {};
  std::sort(angles.begin(), angles.end());
  const auto at = [&](double share) {
    return angles[static_cast<std::size_t>(share * static_cast<double>(angles.size() - 1) + 0.5)];
  };
  return {at(0.5), at(0.99)};
}

// Makes a ball of a joint whose residual over the clips is too large, and says so.
void promote_if_needed(const std::vector<Quat>& rotations, const std::string& name,
                       const char* turns, JointModel& joint, std::vector<std::string>& notes) {
  const ResidualSize size = residual_size(joint, rotations);
  if (size.median <= kMedianResidual && size.high <= kHighResidual) return;
  char text[200];
  std::snprintf(text, sizeof text,
                " %s in the clips (by %.0f° in the median, up to %.0f° in 99 %% of the time)",
                turns, size.median / kDegree, size.high / kDegree);
  notes.push_back("'" + name + "'" + text +
                  ": it is modelled with three DOFs, in the range of the clips");
  joint.kind = JointModelKind::ball;
}

// Other joints at the end's own place, which turning it would leave behind.
bool shares_its_place(const Rig& rig, double lower_length) {
  const int end = rig.limb.end;
  const int parent = rig.joint(end).parent;
  if (parent < 0) return false;
  const auto& siblings = rig.model.skeleton.children[static_cast<std::size_t>(parent)];
  return std::any_of(siblings.begin(), siblings.end(), [&](int other) {
    return other != end && is_skin_joint(rig.character, other) &&
           glm::distance(origin(rig.globals, other), origin(rig.globals, end)) <
               0.02 * lower_length;
  });
}

// Radial side of the hand: from its other fingers to its thumb, world; nothing without a thumb.
// Some rigs have no hand: thumb and palm bones then stand beside the joint that stands for it.
std::optional<Vec3> thumb_side(const Rig& rig, int hand) {
  const Vec3 wrist = origin(rig.globals, hand);
  const int parent = rig.joint(hand).parent;
  const Vec3 lower = parent < 0 ? Vec3(0.0) : wrist - origin(rig.globals, parent);
  std::vector<int> beside;
  if (parent >= 0 && shares_its_place(rig, glm::length(lower))) {
    for (const int child : rig.figure.children(parent)) {
      if (is_skin_joint(rig.character, child) && rig.figure.carries(child)) beside.push_back(child);
    }
  }
  for (const std::vector<int>& branches : {branches_below(rig.figure, hand, false), beside}) {
    const Digits digits = digits_of(rig.figure, branches, wrist, lower);
    if (digits.thumb < 0 || digits.fingers.empty()) continue;
    Vec3 others(0.0);
    for (const int finger : digits.fingers) others += origin(rig.globals, finger);
    return direction(origin(rig.globals, digits.thumb) -
                     others / static_cast<double>(digits.fingers.size()));
  }
  return std::nullopt;
}

// What the middle joint passes on to root and end: the plane of flexion in the world, as bound.
struct MiddleFit {
  Vec3 straight_y{0.0};  // where flexion moves the lower bone when the limb is straight
  Vec3 bound_y{0.0};     // and from the bind pose
};

Result<MiddleFit> fit_middle(const Rig& rig, LimbModel& fitted, const Vec3& upper,
                             const Vec3& lower, const Vec3& bends_to) {
  const int index = rig.limb.middle;
  JointModel& joint = fitted.joints[1];
  joint.kind = JointModelKind::hinge;
  joint.joint = index;
  const auto space = parent_space(rig, index);
  if (!space) return Error{"the joint's parent has no size", rig.where(index), "repair the rig"};
  joint.side = rig.side * space->mirror;
  const Quat bound = bound_rotation(rig, index);

  FlexionEvidence evidence;
  const auto along_upper = space->from_world(upper), along_lower = space->from_world(lower);
  const auto to = space->from_world(bends_to);
  if (!along_upper || !along_lower || !to) {
    return Error{"the bones at the joint have no direction", rig.where(index), "repair the rig"};
  }
  evidence.upper = *along_upper;
  evidence.bound = *along_lower;
  const auto across = direction_across(*to, evidence.upper);
  if (!across) {
    return Error{"the bone lies along the way it should bend", rig.where(index), "repair the rig"};
  }
  evidence.anatomical = glm::cross(evidence.upper, *across);
  const Vec3 bone = glm::conjugate(bound) * evidence.bound;  // in the joint's own axes
  const std::vector<Quat> rotations = clip_rotations(rig.model, index);
  for (const Quat& rotation : rotations) evidence.clips.push_back(rotation * bone);

  evidence.median_allowed = kMedianResidual;
  evidence.high_allowed = kHighResidual;
  const FlexionAxis found = find_flexion_axis(evidence);
  fitted.flexion_axis_from = found.from;
  const Vec3 straight_y = glm::cross(found.axis, evidence.upper);
  const auto zero = frame_of(evidence.upper, straight_y);
  const Vec3 bound_y = glm::cross(found.axis, evidence.bound);
  const auto frame = frame_of(evidence.bound, bound_y);
  if (!zero || !frame) {
    return Error{"the lower bone lies along the flexion axis", rig.where(index), "repair the rig"};
  }
  joint.parent_from_zero = *zero;
  joint.joint_from_anatomy = glm::normalize(glm::conjugate(bound) * *frame);

  MiddleFit fit;
  const auto world_straight = space->to_world(straight_y);
  const auto world_bound = space->to_world(*frame * Vec3(0, 1, 0));
  if (!world_straight || !world_bound) {
    return Error{"the joint's parent has no size", rig.where(index), "repair the rig"};
  }
  fit.straight_y = *world_straight;
  fit.bound_y = *world_bound;

  // Palms that were not bound facing down: the forearm's twist counts from where they would.
  if (rig.limb.is_arm()) {
    const auto radial = thumb_side(rig, rig.limb.end);
    const auto seen = radial ? direction_across(*radial, lower) : std::nullopt;
    if (seen && glm::dot(*seen, fit.bound_y) < std::cos(kPalmTurned)) {
      const auto seen_here = space->from_world(*seen);
      const auto turned = seen_here ? frame_of(evidence.bound, *seen_here) : std::nullopt;
      if (turned) {
        joint.joint_from_anatomy = glm::normalize(glm::conjugate(bound) * *turned);
        fit.bound_y = *seen;
        fitted.notes.push_back("the palm was bound turned about the forearm: '" +
                               rig.joint(index).name + "' counts its twist by the thumb");
      }
    }
  }
  promote_if_needed(rotations, rig.joint(index).name, "leaves its plane of flexion", joint,
                    fitted.notes);
  return fit;
}

Result<Done> fit_root(const Rig& rig, LimbModel& fitted, const Vec3& upper,
                      const MiddleFit& middle) {
  const int index = rig.limb.root;
  JointModel& joint = fitted.joints[0];
  joint.kind = JointModelKind::ball;
  joint.joint = index;
  const Error degenerate{"the joint's axes cannot be told", rig.where(index), "repair the rig"};
  const auto space = parent_space(rig, index);
  if (!space) return degenerate;
  joint.side = rig.side * space->mirror;

  // The elbow bends towards y; the hip bends against the knee.
  const bool leg = rig.limb.kind == LimbKind::left_leg || rig.limb.kind == LimbKind::right_leg;
  const auto bone = space->from_world(upper);
  const auto y = space->from_world(leg ? -middle.straight_y : middle.straight_y);
  const auto frame = bone && y ? frame_of(*bone, *y) : std::nullopt;
  if (!frame) return degenerate;
  joint.joint_from_anatomy = glm::normalize(glm::conjugate(bound_rotation(rig, index)) * *frame);

  const BodyAxes& body = rig.body;
  const auto up = space->from_world(body.up), outward = space->from_world(rig.outward),
             forward = space->from_world(body.forward);
  if (!up || !outward || !forward) return degenerate;
  fitted.up = *up;
  fitted.outward = *outward;
  fitted.forward = *forward;

  if (rig.limb.kind == LimbKind::chain) {
    joint.parent_from_zero = *frame;
    return Done{};
  }
  // From the T-pose (standing) by the shortest swing to the zero pose.
  const ZeroDirection zero = zero_direction(!leg);
  const Vec3 zero_bone =
      glm::normalize(rig.outward * zero.outward + body.up * zero.up + body.forward * zero.forward);
  const Vec3 canonical = leg ? -body.up : rig.outward;
  const Vec3 zero_y = shortest_rotation(canonical, zero_bone) * body.forward;
  const auto x0 = space->from_world(zero_bone), y0 = space->from_world(zero_y);
  const auto zero_frame = x0 && y0 ? frame_of(*x0, *y0) : std::nullopt;
  if (!zero_frame) return degenerate;
  joint.parent_from_zero = *zero_frame;
  return Done{};
}

bool rotated_by_a_clip(const Model& model, int joint) {
  return std::any_of(model.clips.begin(), model.clips.end(), [&](const Clip& clip) {
    return clip.find_channel(joint, Path::rotation) >= 0;
  });
}

// Twist of a swing's rotations that leaves the least residual in the median: of the observed twists
// the one with the least sum of distances, coarse to fine.
double central_twist(const JointModel& joint, const std::vector<Quat>& rotations) {
  std::vector<double> twists;
  for (const Quat& rotation : rotations) {
    double q[3];
    Quat residual;
    decompose(joint, rotation, q, residual);
    twists.push_back(2 * std::atan2(residual.x, residual.w));
  }
  const auto cost = [&](double centre) {
    double sum = 0;
    for (const double twist : twists) sum += std::abs(std::remainder(twist - centre, 2 * kPi));
    return sum;
  };
  double best = 0, least = cost(0);
  double span = kPi;
  for (int level = 0; level < 4; ++level) {
    const double centre = best, step = span / 18;
    for (int i = -18; i <= 18; ++i) {
      const double value = cost(centre + step * i);
      if (value < least) {
        least = value;
        best = centre + step * i;
      }
    }
    span = step;
  }
  return std::remainder(best, 2 * kPi);
}

Result<Done> fit_end(const Rig& rig, LimbModel& fitted, const Vec3& lower, double lower_length,
                     const MiddleFit& middle) {
  const int index = rig.limb.end;
  JointModel& joint = fitted.joints[2];
  joint.kind = JointModelKind::swing;
  joint.joint = index;
  const Joint& node = rig.joint(index);
  const bool moves = moves_something(rig.model, rig.character, index);
  const bool shared = shares_its_place(rig, lower_length);
  if (node.rest_matrix || ((!moves || shared) && !rotated_by_a_clip(rig.model, index))) {
    joint.kind = JointModelKind::fixed;
    joint.parent_from_zero = node.rest.rotation;
    fitted.notes.push_back("'" + node.name + "' is not turned: " +
                           (node.rest_matrix ? "it is placed by a matrix"
                            : !moves         ? "nothing follows it"
                                             : "other joints start in the same place"));
    return Done{};
  }

  const Error degenerate{"the joint's axes cannot be told", rig.where(index), "repair the rig"};
  const auto space = parent_space(rig, index);
  if (!space) return degenerate;
  joint.side = rig.side * space->mirror;
  const Quat bound = bound_rotation(rig, index);

  const std::optional<Vec3> beyond = extremity(rig.figure, index, rig.limb.is_arm());
  const bool leg = rig.limb.kind == LimbKind::left_leg || rig.limb.kind == LimbKind::right_leg;
  std::optional<Quat> zero, frame;
  if (leg) {
    // Zero as bound; x along the shin, y to where the toes point: bending up is positive, and what
    // turns about the shin is the knee's to do.
    const auto x = space->from_world(lower);
    auto toes = beyond ? direction_across(*beyond, lower) : std::nullopt;
    if (!toes) toes = direction_across(rig.body.forward, lower);
    const auto y = toes ? space->from_world(*toes) : std::nullopt;
    zero = x && y ? frame_of(*x, *y) : std::nullopt;
    frame = zero;
  } else {
    // Zero along the forearm, y to the palm: with the thumb on the side to which the elbow bends,
    // the palm faces down in the T-pose.
    const Vec3 palm = rig.side * glm::cross(lower, middle.bound_y);
    const Vec3 hand = beyond ? *direction(*beyond) : lower;
    const Vec3 hand_palm = shortest_rotation(lower, hand) * palm;
    const auto x0 = space->from_world(lower), y0 = space->from_world(palm);
    const auto x1 = space->from_world(hand), y1 = space->from_world(hand_palm);
    zero = x0 && y0 ? frame_of(*x0, *y0) : std::nullopt;
    frame = x1 && y1 ? frame_of(*x1, *y1) : std::nullopt;
    if (rig.limb.kind == LimbKind::chain) zero = frame;
  }
  if (!zero || !frame) return degenerate;
  joint.parent_from_zero = *zero;
  joint.joint_from_anatomy = glm::normalize(glm::conjugate(bound) * *frame);

  const std::vector<Quat> rotations = clip_rotations(rig.model, index);
  if (rotations.empty()) return Done{};
  // A twist that is always there is no motion: centre it.
  JointModel centred = joint;
  const double twist = central_twist(joint, rotations);
  centred.joint_from_anatomy =
      glm::normalize(joint.joint_from_anatomy * glm::angleAxis(-twist, Vec3(1, 0, 0)));
  const std::size_t notes = fitted.notes.size();
  promote_if_needed(rotations, node.name, "twists", centred, fitted.notes);
  if (fitted.notes.size() > notes) {
    joint.kind = JointModelKind::ball;  // its twist is a DOF and counts from the bind pose
  } else {
    joint = centred;
  }
  return Done{};
}

// The DOFs that a joint has only as a ball have no range in anatomy: a rig that bends an elbow
// sideways means a turned upper arm by it. They may do what 98 % of the clips' time shows.
void widen_to_clips(const JointModel& joint, LimbJointRole role, const std::vector<Quat>& rotations,
                    DofSpace& space) {
  if (joint.kind != JointModelKind::ball || role == LimbJointRole::root || rotations.empty())
    return;
  std::array<std::vector<double>, 3> values;
  for (const Quat& rotation : rotations) {
    double q[3];
    Quat residual;
    decompose(joint, rotation, q, residual);
    for (std::size_t i = 0; i < 3; ++i) values[i].push_back(q[i]);
  }
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
    if (i == 0 && role == LimbJointRole::end) continue;  // a wrist's swing is anatomy
    std::sort(values[i].begin(), values[i].end());
    const auto at = [&](double share) {
      return values[i][static_cast<std::size_t>(share * static_cast<double>(values[i].size() - 1) +
                                                0.5)];
    };
    Dof& dof = space.dofs[static_cast<std::size_t>(joint.first_dof) + i];
    dof.lower = std::min(dof.lower, at(0.01));
    dof.upper = std::max(dof.upper, at(0.99));
    dof.sample_lower = std::min(dof.sample_lower, at(0.01));
    dof.sample_upper = std::max(dof.sample_upper, at(0.99));
  }
}

}  // namespace

Result<LimbModel> fit_limb_model(const Model& model, const Character& character, const Limb& limb,
                                 const LimbFindings& findings) {
  const int count = model.skeleton.size();
  for (const int joint : {limb.root, limb.middle, limb.end}) {
    if (joint < 0 || joint >= count) {
      return Error{"the limb '" + limb.name + "' has no joint " + std::to_string(joint),
                   model.path.filename().string(), "find the limb anew"};
    }
  }
  const BoundFigure figure = bound_figure(model, character);
  Rig rig{figure, model, character, limb, figure.globals, {}, Vec3(1, 0, 0), 1};
  rig.body = find_body_axes(figure, findings.limbs).axes;
  for (const int joint : {limb.root, limb.middle}) {
    if (rig.joint(joint).rest_matrix) {
      return Error{"the joint is placed by a matrix and cannot be animated", rig.where(joint),
                   "export it with translation, rotation and scale"};
    }
  }
  const Vec3 root = origin(rig.globals, limb.root);
  const Vec3 upper_bone = origin(rig.globals, limb.middle) - root;
  const Vec3 lower_bone = origin(rig.globals, limb.end) - origin(rig.globals, limb.middle);
  const auto upper = direction(upper_bone), lower = direction(lower_bone);
  if (!upper || !lower) {
    return Error{"the joint lies where the next one of the limb does",
                 rig.where(upper ? limb.middle : limb.root), "name another chain of joints"};
  }

  // Which side of the body the limb is on: by where it stands among the limbs found; its name only
  // if that is in the middle.
  Vec3 centre(0.0);
  for (const Limb& other : findings.limbs) centre += origin(rig.globals, other.root);
  if (!findings.limbs.empty()) centre /= static_cast<double>(findings.limbs.size());
  const double place = glm::dot(root - centre, rig.body.left);
  const bool clear = std::abs(place) > 0.02 * glm::length(upper_bone) && findings.limbs.size() > 1;
  rig.side = (clear ? place >= 0 : limb.is_left() || limb.kind == LimbKind::chain) ? 1 : -1;
  rig.outward = rig.side * rig.body.left;

  // Where the middle joint bends to, if nothing else tells: an elbow forward in the T-pose, a knee
  // back. The pose of the bone as bound is reached from there by the shortest swing.
  const bool leg = limb.kind == LimbKind::left_leg || limb.kind == LimbKind::right_leg;
  const Vec3 canonical = leg ? -rig.body.up : rig.outward;
  Vec3 bends_to = shortest_rotation(canonical, *upper) * rig.body.forward;
  if (leg) bends_to = -bends_to;

  LimbModel fitted;
  fitted.limb = limb;
  const auto middle = fit_middle(rig, fitted, *upper, *lower, bends_to);
  if (!middle) return middle.error();
  if (const auto done = fit_root(rig, fitted, *upper, *middle); !done) return done.error();
  if (const auto done = fit_end(rig, fitted, *lower, glm::length(lower_bone), *middle); !done) {
    return done.error();
  }

  const std::array<LimbJointRole, 3> roles = {LimbJointRole::root, LimbJointRole::middle,
                                              LimbJointRole::end};
  fitted.grasp = fit_grasp_frame({figure, limb, rig.side, -rig.body.up, *lower,
                                  rig.side * glm::cross(*lower, middle->bound_y),
                                  fitted.joints[2].kind == JointModelKind::fixed});
  for (std::size_t i = 0; i < 3; ++i) {
    JointModel& joint = fitted.joints[i];
    joint.first_dof = fitted.space.count();
    append_dofs(limb.kind, roles[i], joint, rig.joint(joint.joint).name, fitted.space);
    widen_to_clips(joint, roles[i], clip_rotations(model, joint.joint), fitted.space);
  }
  int serves = limb.root;
  for (const int joint : limb.joints) {
    if (joint == limb.root || joint == limb.middle || joint == limb.end) {
      serves = joint;
    } else {
      fitted.driven.push_back({joint, serves});
    }
  }
  for (const int joint : limb.beside) fitted.driven.push_back({joint, rig.joint(joint).parent});
  return fitted;
}

}  // namespace elbowroom
