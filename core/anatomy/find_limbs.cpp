// SPDX-License-Identifier: MIT
// Whose word counts about which joints are a limb: the animator's, then the file's own (VRM), then
// the joints' names, then the figure's shape.
#include <algorithm>
#include <array>
#include <optional>

#include "core/anatomy/bind_geometry.h"
#include "core/anatomy/body_axes.h"
#include "core/anatomy/limb.h"
#include "core/anatomy/limb_joints.h"
#include "core/anatomy/named_limbs.h"
#include "core/anatomy/shaped_limbs.h"

namespace elbowroom {
namespace {

constexpr std::array<LimbKind, 4> kKinds = {LimbKind::left_arm, LimbKind::right_arm,
                                            LimbKind::left_leg, LimbKind::right_leg};
// How clearly feet, knees and elbows must say that a figure of unknown sides looks the other way.
constexpr double kTurned = -0.25;

std::size_t slot(LimbKind kind) { return static_cast<std::size_t>(kind); }

class Finder {
 public:
  Finder(const Model& model, const Character& character, const LimbOverrides& overrides)
      : model_(model),
        character_(character),
        overrides_(overrides),
        figure_(bound_figure(model, character)) {
    reasons_.fill("no joint says so");
  }

  LimbFindings find() {
    collect_members();
    take_overrides();
    take_file();
    take_names();
    take_shapes();
    settle_sides();
    drop_denied();
    settle_following();
    warn_of_left_behind();
    LimbFindings findings;
    for (const LimbKind kind : kKinds) {
      if (found_[slot(kind)]) {
        findings.limbs.push_back(*found_[slot(kind)]);
        for (const std::string& warning : limb_warnings_[slot(kind)])
          findings.warnings.push_back(std::string(limb_id(kind)) + ": " + warning);
      } else {
        findings.warnings.push_back(std::string(limb_id(kind)) +
                                    " not found: " + reasons_[slot(kind)] + advice(kind));
      }
    }
    for (const Limb& chain : chains_) findings.limbs.push_back(chain);
    for (const std::string& warning : warnings_) findings.warnings.push_back(warning);
    if (find_body_axes(figure_, findings.limbs).mirrored_names) {
      findings.warnings.push_back(
          "left and right seem swapped in the joints' names: the figure is mirrored, or feet, "
          "knees "
          "and elbows face the other way; limbs are called as the names have it");
    }
    return findings;
  }

 private:
  std::string quoted(int joint) const { return quoted_joint(model_, joint); }

  // Joints of a skin, and what stands between or below them but plain meshes.
  void collect_members() {
    const Skeleton& skeleton = model_.skeleton;
    std::vector<char> mesh_node(skeleton.joints.size(), 0), within(skeleton.joints.size(), 0);
    for (const Mesh& mesh : model_.meshes) {
      if (mesh.node >= 0) mesh_node[static_cast<std::size_t>(mesh.node)] = 1;
    }
    for (const int joint : skeleton.order) {
      const auto j = static_cast<std::size_t>(joint);
      const int parent = skeleton.joints[j].parent;
      const bool below = parent >= 0 && within[static_cast<std::size_t>(parent)] && !mesh_node[j];
      if (!is_skin_joint(character_, joint) && !below) continue;
      within[j] = 1;
      members_.push_back(joint);
    }
  }

  void take_overrides() {
    for (const auto& [name, joints] : overrides_) {
      if (joints.none()) continue;  // see drop_denied
      const auto limb = limb_between(model_, character_, name, joints);
      if (!limb) {
        warnings_.push_back(name + ", as it was set by hand, is not there: " + limb.error().what);
        continue;
      }
      if (limb->kind == LimbKind::chain) {
        chains_.push_back(*limb);
      } else {
        found_[slot(limb->kind)] = *limb;
      }
    }
  }

  // The bones that the file itself names (VRM).
  void take_file() {
    const std::array<std::array<const char*, 3>, 4> bones = {{
        {"leftUpperArm", "leftLowerArm", "leftHand"},
        {"rightUpperArm", "rightLowerArm", "rightHand"},
        {"leftUpperLeg", "leftLowerLeg", "leftFoot"},
        {"rightUpperLeg", "rightLowerLeg", "rightFoot"},
    }};
    for (const LimbKind kind : kKinds) {
      std::array<int, 3> joints = {-1, -1, -1};
      for (const HumanBone& bone : model_.human_bones) {
        for (std::size_t i = 0; i < 3; ++i) {
          if (bone.bone == bones[slot(kind)][i] && joints[i] < 0) joints[i] = bone.node;
        }
      }
      if (found_[slot(kind)] || joints[0] < 0 || joints[1] < 0 || joints[2] < 0) continue;
      if (!is_chain(joints[0], joints[1], joints[2])) {
        limb_warnings_[slot(kind)].push_back(
            "the file's own humanoid bones for it are no chain of joints (" + quoted(joints[0]) +
            ", " + quoted(joints[1]) + ", " + quoted(joints[2]) + ") and are passed over");
        continue;
      }
      put(kind, joints[0], joints[1], joints[2],
          std::string("the file's own humanoid bones: ") + bones[slot(kind)][0] + " is " +
              quoted(joints[0]) + ", " + bones[slot(kind)][1] + " " + quoted(joints[1]) + ", " +
              bones[slot(kind)][2] + " " + quoted(joints[2]));
    }
  }

  void take_names() {
    const std::array<NamedLimb, 4> named = find_named_limbs(figure_, members_);
    for (const LimbKind kind : kKinds) {
      const NamedLimb& limb = named[slot(kind)];
      if (found_[slot(kind)]) continue;
      if (limb.root < 0) {
        reasons_[slot(kind)] = limb.why;
        continue;
      }
      detached_[slot(kind)] = limb.detached;
      put(kind, limb.root, limb.middle, limb.end, limb.why);
      unsure_[slot(kind)] = limb.side_by_place;
      found_[slot(kind)]->named_side = !limb.side_by_place;
    }
  }

  void take_shapes() {
    if (std::all_of(found_.begin(), found_.end(), [](const auto& limb) { return !!limb; })) return;
    const ShapedLimbs shaped = find_shaped_limbs(figure_, members_);
    take_pair(shaped.arms, LimbKind::left_arm, LimbKind::right_arm, shaped.no_arms);
    take_pair(shaped.legs, LimbKind::left_leg, LimbKind::right_leg, shaped.no_legs);
  }

  void take_pair(const std::optional<ShapedPair>& pair, LimbKind left, LimbKind right,
                 const std::string& none) {
    if (!pair) {
      for (const LimbKind kind : {left, right}) {
        if (!found_[slot(kind)]) reasons_[slot(kind)] += "; by shape: " + none;
      }
      return;
    }
    std::array<bool, 2> taken = {overlaps((*pair)[0]), overlaps((*pair)[1])};
    if (!found_[slot(left)] && !found_[slot(right)]) {
      if (taken[0] || taken[1]) {
        for (const LimbKind kind : {left, right})
          reasons_[slot(kind)] += "; by shape it would be joints of another limb";
        return;
      }
      const Vec3 line = figure_.place((*pair)[0].root) - figure_.place((*pair)[1].root);
      if (left_ == Vec3(0.0)) {
        // glTF figures face +z; one that faces along x has its left along z.
        const bool sideways = std::abs(line.z) > std::abs(line.x);
        left_ = (sideways ? line.z : line.x) >= 0 ? line : -line;
      }
      const std::size_t first = glm::dot(line, left_) >= 0 ? 0 : 1;
      put_shape(left, (*pair)[first]);
      put_shape(right, (*pair)[1 - first]);
      return;
    }
    // One of them is known: the other of the pair is its image.
    const LimbKind missing = found_[slot(left)] ? right : left;
    if (found_[slot(missing)]) return;
    if (taken[0] == taken[1]) {
      reasons_[slot(missing)] += "; by shape no chain is the other side's image";
      return;
    }
    put_shape(missing, (*pair)[taken[0] ? 1 : 0]);
    unsure_[slot(missing)] = false;
  }

  void put_shape(LimbKind kind, const ShapedLimb& limb) {
    put(kind, limb.root, limb.middle, limb.end,
        "shape (its names say nothing): " + limb.why + "; root " + quoted(limb.root) + ", middle " +
            quoted(limb.middle) + ", end " + quoted(limb.end));
    unsure_[slot(kind)] = true;
    found_[slot(kind)]->named_side = false;
  }

  bool overlaps(const ShapedLimb& limb) const {
    return std::any_of(found_.begin(), found_.end(), [&](const auto& other) {
      return other && (model_.skeleton.is_within(limb.root, other->root) ||
                       model_.skeleton.is_within(other->root, limb.root));
    });
  }

  // Sides that nothing told were taken as facing +z. Where others are sure, theirs count; else
  // feet, knees and elbows show which way the figure looks.
  void settle_sides() {
    std::vector<Limb> sure, all;
    for (const LimbKind kind : kKinds) {
      if (!found_[slot(kind)]) continue;
      all.push_back(*found_[slot(kind)]);
      if (!unsure_[slot(kind)]) sure.push_back(*found_[slot(kind)]);
    }
    if (sure.size() == all.size()) return;
    const BodyFindings by_sure = find_body_axes(figure_, sure);
    bool turned = false;
    if (!by_sure.paired) {
      const BodyFindings by_all = find_body_axes(figure_, all);
      turned = by_all.mirrored_names ||
               looks_along(figure_, all, by_all.axes.up, by_all.axes.forward) < kTurned;
    }
    for (const auto& [left, right] : {std::pair(LimbKind::left_arm, LimbKind::right_arm),
                                      std::pair(LimbKind::left_leg, LimbKind::right_leg)}) {
      if (!unsure_[slot(left)] && !unsure_[slot(right)]) continue;
      bool swap = turned;
      if (by_sure.paired && found_[slot(left)] && found_[slot(right)]) {
        const Vec3 line =
            figure_.place(found_[slot(left)]->root) - figure_.place(found_[slot(right)]->root);
        swap = glm::dot(line, by_sure.axes.left) < 0;
      }
      if (swap) {
        std::swap(found_[slot(left)], found_[slot(right)]);
        std::swap(limb_warnings_[slot(left)], limb_warnings_[slot(right)]);
        std::swap(reasons_[slot(left)], reasons_[slot(right)]);
        std::swap(detached_[slot(left)], detached_[slot(right)]);
      }
      for (const LimbKind kind : {left, right}) {
        if (!found_[slot(kind)]) continue;
        found_[slot(kind)]->kind = kind;
        found_[slot(kind)]->name = limb_id(kind);
        found_[slot(kind)]->why += by_sure.paired ? "; the side by the other limbs'"
                                   : turned ? "; the side by where feet, knees and elbows look"
                                            : "; the side by where it stands, facing +z";
      }
    }
  }

  // A joint follows one limb, from outside all others, and the chains which that hangs from.
  void settle_following() {
    std::vector<Limb*> all;
    for (const LimbKind kind : kKinds)
      if (found_[slot(kind)]) all.push_back(&*found_[slot(kind)]);
    for (Limb& chain : chains_) all.push_back(&chain);
    for (std::size_t i = 0; i < all.size(); ++i)
      std::erase_if(all[i]->following, [&](const FollowingJoint& own) {
        for (std::size_t k = 0; k < all.size(); ++k) {
          if (k == i) continue;
          if (model_.skeleton.is_within(own.joint, all[k]->root) ||
              model_.skeleton.is_within(all[k]->root, own.joint) ||
              (k < i && all[k]->follows(own.joint)))
            return true;
        }
        return false;
      });
    for (Limb& chain : chains_) take_along_below(figure_, chain, {all.begin(), all.end()});
  }

  // Of what belongs to a limb but hangs elsewhere, what cannot follow it.
  void warn_of_left_behind() {
    for (const LimbKind kind : kKinds) {
      if (!found_[slot(kind)]) continue;
      const Limb& limb = *found_[slot(kind)];
      std::vector<int> behind;
      std::string reason = "it is another limb's too, or too far away";
      const auto along = [&](int joint) {
        return std::any_of(limb.following.begin(), limb.following.end(), [&](const auto& own) {
          return model_.skeleton.is_within(joint, own.joint);
        });
      };
      const auto add = [&](int joint) {
        if (figure_.carries(joint) && !along(joint) &&
            std::find(behind.begin(), behind.end(), joint) == behind.end())
          behind.push_back(joint);
      };
      for (const DetachedJoint& joint : detached_joints(figure_, limb, detached_[slot(kind)])) {
        if (!joint.obstacle.empty() && behind.empty()) reason = joint.obstacle;
        add(joint.joint);
      }
      for (const int joint : detached_[slot(kind)]) add(joint);
      if (behind.empty()) continue;
      const int parent = figure_.parent(behind.front());
      const std::string from = parent < 0 ? " free" : " from " + quoted(parent);
      const std::string more = " and " + std::to_string(behind.size() - 1) + " more";
      limb_warnings_[slot(kind)].push_back(
          quoted(behind.front()) +
          (behind.size() == 1 ? " belongs to it by its name or place but hangs"
                              : more + " belong to it by their name or place but hang") +
          from + ", and will not follow it: " + reason);
    }
  }

  // What can be done about a limb that is not found.
  std::string advice(LimbKind kind) const {
    const auto set = overrides_.find(limb_id(kind));
    if (set != overrides_.end() && set->second.none()) return "";
    return std::string("; if it has one, name its joints: \"limbs\": {\"") + limb_id(kind) +
           "\": [from, middle, to]} in a project file, or the editor's \"Joints of the limbs\"";
  }

  // What was said to be no limb is found first, for it tells the sides of the others.
  void drop_denied() {
    for (const LimbKind kind : kKinds) {
      const auto set = overrides_.find(limb_id(kind));
      if (set == overrides_.end() || !set->second.none()) continue;
      found_[slot(kind)].reset();
      reasons_[slot(kind)] = "it was said by hand to be no limb";
    }
  }

  bool is_chain(int root, int middle, int end) const {
    const int count = model_.skeleton.size();
    for (const int joint : {root, middle, end}) {
      if (joint < 0 || joint >= count) return false;
    }
    const double upper = glm::distance(figure_.place(root), figure_.place(middle));
    const double lower = glm::distance(figure_.place(middle), figure_.place(end));
    const double least = 1e-6 * std::max(character_.height, upper + lower);
    return root != middle && middle != end && model_.skeleton.is_within(middle, root) &&
           model_.skeleton.is_within(end, middle) && upper > least && lower > least;
  }

  void put(LimbKind kind, int root, int middle, int end, const std::string& why) {
    Limb limb;
    limb.kind = kind;
    limb.name = limb_id(kind);
    limb.root = root;
    limb.middle = middle;
    limb.end = end;
    limb.why = why;
    complete_limb(figure_, limb, detached_[slot(kind)]);
    limb.named_side = true;
    found_[slot(kind)] = limb;
  }

  const Model& model_;
  const Character& character_;
  const LimbOverrides& overrides_;
  BoundFigure figure_;
  std::vector<int> members_;
  std::array<std::optional<Limb>, 4> found_;
  std::array<bool, 4> unsure_{};  // which side it is on was guessed
  std::array<std::string, 4> reasons_;
  std::array<std::vector<std::string>, 4> limb_warnings_;
  std::array<std::vector<int>, 4> detached_;  // NamedLimb's
  Vec3 left_{0.0};            // of pairs found by shape, for the time being; none: not chosen
  std::vector<Limb> chains_;  // set by hand
  std::vector<std::string> warnings_;
};

}  // namespace

const char* limb_id(LimbKind kind) {
  switch (kind) {
    case LimbKind::left_arm:
      return "left_arm";
    case LimbKind::right_arm:
      return "right_arm";
    case LimbKind::left_leg:
      return "left_leg";
    case LimbKind::right_leg:
      return "right_leg";
    case LimbKind::chain:
      break;
  }
  return "chain";
}

LimbFindings find_limbs(const Model& model, const Character& character,
                        const LimbOverrides& overrides) {
  return Finder(model, character, overrides).find();
}

}  // namespace elbowroom
