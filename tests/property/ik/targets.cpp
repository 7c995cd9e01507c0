// SPDX-License-Identifier: MIT
#include "tests/property/ik/targets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/anatomy/limb_clip.h"
#include "core/base/random.h"
#include "core/io/gltf_reader.h"
#include "tests/support/samples.h"

namespace elbowroom::test {
namespace {

constexpr double kPosition = 1e-5;     // × length
constexpr double kOrientation = 1e-4;  // radians
constexpr int kTargetsPerMoment = 20;

Vec3 random_direction(Random& random) {
  for (;;) {
    const Vec3 v(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1));
    const double length = glm::length(v);
    if (length > 0.1 && length < 1) return v / length;
  }
}

Dofs random_posture(const DofSpace& space, Random& random) {
  Dofs q;
  q.count = space.count();
  do {
    for (int i = 0; i < q.count; ++i) {
      const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
      q[i] = random.uniform(dof.lower, dof.upper);
    }
  } while (!space.within_limits(q, 0));
  return q;
}

// All but stretched: what is reached then may hang on the twist.
void stretch(const LimbIk& ik, const LimbModel& limb, Random& random, Dofs& q) {
  const JointModel& middle = limb.joints[1];
  const int bend = middle.first_dof + (middle.kind == JointModelKind::ball ? 1 : 0);
  const Dof& dof = limb.space.dofs[static_cast<std::size_t>(bend)];
  const auto distance = [&](double angle) {
    Dofs bent = q;
    bent[bend] = angle;
    const auto points = ik.points(bent);
    return glm::distance(points.end, points.root);
  };
  double best = dof.lower;
  for (int i = 0; i <= 200; ++i) {
    const double angle = dof.lower + (dof.upper - dof.lower) * i / 200;
    if (distance(angle) > distance(best)) best = angle;
  }
  const double off = std::pow(10.0, random.uniform(-5, -1));
  Dofs straight = q;
  straight[bend] = std::clamp(best + (random.below(2) == 0 ? off : -off), dof.lower, dof.upper);
  if (limb.space.within_limits(straight, 0)) q = straight;
}

DofSpace tighter(const DofSpace& whole, Random& random) {
  DofSpace space = whole;
  for (Dof& dof : space.dofs) {
    const double width = dof.upper - dof.lower;
    const double kept = width * random.uniform(0.2, 0.8);
    dof.lower += (width - kept) * random.uniform();
    dof.upper = dof.lower + kept;
  }
  // Ellipses too, unless nothing would be left.
  const std::vector<EllipseLimit> before = space.ellipses;
  for (EllipseLimit& ellipse : space.ellipses) {
    ellipse.half_first *= random.uniform(0.6, 1);
    ellipse.half_second *= random.uniform(0.6, 1);
  }
  const auto left = [&] {
    for (const EllipseLimit& ellipse : space.ellipses) {
      double sum = 0;
      for (const auto& [dof, half] : {std::pair(ellipse.first, ellipse.half_first),
                                      std::pair(ellipse.second, ellipse.half_second)}) {
        const Dof& limits = space.dofs[static_cast<std::size_t>(dof)];
        const double least = std::max({0.0, limits.lower, -limits.upper}) / half;
        sum += least * least;
      }
      if (sum > 0.99) return false;
    }
    return true;
  };
  if (!left()) space.ellipses = before;
  return left() ? space : whole;
}

// Balls that elbow and forearm must keep out of.
struct Obstacles {
  struct Ball {
    Vec3 centre;
    double radius;
  };
  std::vector<Ball> balls;

  bool free(const EndPlace& place) const {
    for (const Ball& ball : balls)
      for (const double u : {0.0, 0.3, 0.6, 0.9})
        if (glm::distance(place.middle + (place.position - place.middle) * u, ball.centre) <
            ball.radius)
          return false;
    return true;
  }
};

// The turns of the twists that limits allow, by trying them.
bool allowed_by_turns(const LimbModel& limb, const DofSpace& space, Dofs& q) {
  std::vector<int> turning;
  for (const JointModel& joint : limb.joints) {
    if (joint.kind == JointModelKind::hinge) turning.push_back(joint.first_dof);
    if (joint.kind == JointModelKind::hinge) turning.push_back(joint.first_dof + 1);
    if (joint.kind == JointModelKind::ball) turning.push_back(joint.first_dof + 2);
  }
  for (const int i : turning) {
    const Dof& dof = space.dofs[static_cast<std::size_t>(i)];
    for (const double turn : {-2 * kPi, 2 * kPi})
      if (q[i] + turn >= dof.lower && q[i] + turn <= dof.upper &&
          !(q[i] >= dof.lower && q[i] <= dof.upper))
        q[i] += turn;
  }
  return space.within_limits(q);
}

class Trial {
 public:
  Trial(const LimbInPose& moment, const LimbIk& ik, TargetCounts& counts, Random& random)
      : moment_(moment), ik_(ik), counts_(counts), random_(random) {}

  void run(int kind) {
    const LimbModel& limb = *moment_.limb;
    Dofs q = random_posture(limb.space, random_);
    if (kind == 4) stretch(ik_, limb, random_, q);
    const EndPlace made = place_of(moment_, {q, moment_.residual});
    IkTarget target;
    target.position = made.position;
    const bool oriented = random_.below(2) == 0;
    if (oriented) target.orientation = made.rotation;
    if (kind == 3) {
      far_away(target);
      return;
    }
    DofSpace space = limb.space;
    Obstacles obstacles;
    if (kind == 1) space = tighter(space, random_);
    if (kind == 2) {
      const auto points = ik_.points(q);
      for (int i = 0; i < 3; ++i)
        obstacles.balls.push_back(
            {points.middle + random_direction(random_) * ik_.length() * random_.uniform(0.0, 0.6),
             ik_.length() * random_.uniform(0.05, 0.3)});
    }
    SwivelSearch settings;
    settings.limits = &space;
    const auto valid = [&](const LimbState& state) {
      return obstacles.balls.empty() || obstacles.free(place_of(moment_, state));
    };
    const IkResult result = search_swivel(ik_, target, settings, valid);
    ++counts_.targets;
    const bool reachable = kind == 0 || kind == 4;
    if (reachable) ++counts_.reachable;
    if (result.solved()) {
      ++counts_.solved;
      judge(result, target, space, obstacles);
      return;
    }
    ++counts_.not_solved;
    if (!space.within_limits(result.state.q, 1e-6))
      problem(counts_.beyond_limits, "what is shown instead is beyond limits");
    if (reachable) {
      char text[200];
      std::snprintf(text, sizeof text,
                    "a posture in limits is not found%s%s: %s, %.3g of the length short, %.3g rad "
                    "beyond limits",
                    kind == 4 ? ", all but stretched" : "", oriented ? ", turned" : "",
                    ik_status_id(result.status), result.miss / ik_.length(), result.excess);
      problem(counts_.reachable_missed, text);
      return;
    }
    if (++counts_.failed_but_scanned % 4 != 0) return;
    // Whatever a scan of the swivel finds has to have been found.
    if (scan(target, space, obstacles, 0))
      problem(counts_.scan_found_more, "a scan of whole degrees finds a posture");
    if (scan(target, space, obstacles, random_.uniform(0, kPi / 180))) ++counts_.between_degrees;
  }

 private:
  void problem(long& count, const std::string& what) {
    ++count;
    if (counts_.first_problem.empty())
      counts_.first_problem = moment_.limb->limb.name + ": " + what;
  }

  void judge(const IkResult& result, const IkTarget& target, const DofSpace& space,
             const Obstacles& obstacles) {
    const EndPlace place = place_of(moment_, result.state);
    const double off = glm::distance(place.position, target.position) / ik_.length();
    counts_.worst_position = std::max(counts_.worst_position, off);
    if (!(off <= kPosition)) problem(counts_.wrong_position, "position");
    if (target.orientation && result.orientation_served) {
      const double turned = angle_between(place.rotation, *target.orientation);
      counts_.worst_orientation = std::max(counts_.worst_orientation, turned);
      if (!(turned <= kOrientation)) problem(counts_.wrong_orientation, "orientation");
    }
    if (!space.within_limits(result.state.q)) problem(counts_.beyond_limits, "limits");
    if (!obstacles.free(place)) problem(counts_.in_obstacle, "obstacle");
  }

  void far_away(IkTarget target) {
    const Vec3 root = ik_.points(ik_.current()).root;
    target.position =
        root + random_direction(random_) * ik_.length() * (1 + 1e-5 + random_.uniform(0, 3));
    const IkResult result = search_swivel(ik_, target);
    ++counts_.targets;
    ++counts_.outside;
    const double distance = glm::distance(target.position, root);
    const EndPlace shown = place_of(moment_, result.state);
    const double slack = 1e-5 * ik_.length();
    const auto wrong = [&](const char* what) {
      char text[200];
      std::snprintf(
          text, sizeof text,
          "out of reach, but %s: %s, target at %.9g of the length, %.3g short, shown %.9g "
          "from it",
          what, ik_status_id(result.status), distance / ik_.length(), result.miss / ik_.length(),
          glm::distance(shown.position, target.position) / ik_.length());
      problem(counts_.outside_wrong, text);
    };
    if (result.status != IkStatus::out_of_reach || !(result.miss > 0))
      wrong("not said so");
    else if (ik_.uniform() && result.miss < distance - ik_.length() - slack)
      wrong("by more than is said");
    else if (!moment_.limb->space.within_limits(result.state.q, 1e-6))
      wrong("beyond limits");
    else if (glm::distance(shown.position, target.position) < result.miss - slack)
      wrong("nearer than is said");
  }

  bool scan(const IkTarget& target, const DofSpace& space, const Obstacles& obstacles,
            double phase) {
    for (int i = 0; i < 360; ++i) {
      const double swivel = -kPi + 2 * kPi * i / 360 + phase;
      const IkSolutions solutions = ik_.solve_at_swivel(target, swivel, ik_.current());
      for (int k = 0; k < solutions.count; ++k) {
        IkSolutions::One one = solutions.one[static_cast<std::size_t>(k)];
        if (one.miss != 0 || !allowed_by_turns(*moment_.limb, space, one.q)) continue;
        const EndPlace place = place_of(moment_, {one.q, moment_.residual});
        if (!obstacles.free(place)) continue;
        // Itself checked.
        if (glm::distance(place.position, target.position) > kPosition * ik_.length())
          problem(counts_.wrong_position, "position while scanning");
        return true;
      }
    }
    return false;
  }

  const LimbInPose& moment_;
  const LimbIk& ik_;
  TargetCounts& counts_;
  Random& random_;
};

}  // namespace

std::vector<std::filesystem::path> sample_humanoids() {
  std::vector<std::filesystem::path> paths;
  if (samples_dir().empty()) return paths;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(samples_dir() / "humanoids")) {
    const std::string type = entry.path().extension().string();
    if (type == ".glb" || type == ".gltf" || type == ".vrm") paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

IkRig read_rig(const std::filesystem::path& file) {
  IkRig rig;
  ReadOptions options;
  options.images = false;
  const auto model = read_gltf(file, options);
  if (!model) return rig;
  rig.model = *model;
  for (const Character& character : rig.model->characters) {
    const LimbFindings findings = find_limbs(*rig.model, character);
    for (const Limb& limb : findings.limbs)
      if (auto fitted = fit_limb_model(*rig.model, character, limb, findings))
        rig.limbs.push_back(*fitted);
  }
  return rig;
}

LimbInPose random_moment(const IkRig& rig, const LimbModel& limb, std::uint64_t seed) {
  Random random(seed);
  LimbInPose moment;
  moment.rig = &rig;
  moment.limb = &limb;
  moment.pose = rest_pose(rig.model->skeleton);
  if (!rig.model->clips.empty() && random.below(8) != 0) {
    const Clip& clip = rig.model->clips[random.below(rig.model->clips.size())];
    sample_clip(clip, random.uniform(clip.begin, clip.end), moment.pose);
  }
  moment.residual = limb_state(limb, moment.pose).residual;
  std::vector<Mat4> globals;
  compute_globals(rig.model->skeleton, moment.pose, rig.world_from_file, globals);
  const int parent = rig.model->skeleton.joints[static_cast<std::size_t>(limb.limb.root)].parent;
  moment.world_from_parent =
      parent < 0 ? rig.world_from_file : globals[static_cast<std::size_t>(parent)];
  return moment;
}

EndPlace place_of(const LimbInPose& moment, const LimbState& state) {
  static thread_local Pose pose;
  static thread_local std::vector<Mat4> globals;
  pose = moment.pose;
  apply_limb_state(*moment.limb, state, pose);
  const Skeleton& skeleton = moment.rig->model->skeleton;
  compute_globals(skeleton, pose, moment.rig->world_from_file, globals);
  const Mat4& end = globals[static_cast<std::size_t>(moment.limb->limb.end)];
  const Mat4& middle = globals[static_cast<std::size_t>(moment.limb->limb.middle)];
  return {Vec3(end[3]), Vec3(middle[3]), rotation_of(end)};
}

TargetCounts try_targets(const IkRig& rig, int count, std::uint64_t seed) {
  TargetCounts counts;
  Random random(seed);
  for (const LimbModel& limb : rig.limbs) {
    for (int done = 0; done < count; done += kTargetsPerMoment) {
      const LimbInPose moment = random_moment(rig, limb, random.next());
      const auto ik = LimbIk::build(limb, rig.model->skeleton, moment.pose,
                                    moment.world_from_parent, moment.residual);
      if (!ik) {
        ++counts.wrong_position;
        counts.first_problem = limb.limb.name + ": " + ik.error().message();
        break;
      }
      Trial trial(moment, *ik, counts, random);
      for (int i = 0; i < kTargetsPerMoment && done + i < count; ++i) {
        const int kinds[] = {0, 0, 0, 4, 1, 1, 2, 2, 2, 3};
        trial.run(kinds[i % 10]);
      }
    }
  }
  return counts;
}

std::string summary(const TargetCounts& c) {
  char text[400];
  std::snprintf(text, sizeof text,
                "%ld targets, %ld solved, worst position %.1e of the length, orientation %.1e rad; "
                "%ld of %ld reachable not found, %ld of %ld outside wrong, beyond limits %ld, in "
                "obstacles %ld, a scan found more %ld, between degrees %ld of %ld",
                c.targets, c.solved, c.worst_position, c.worst_orientation, c.reachable_missed,
                c.reachable, c.outside_wrong, c.outside, c.beyond_limits, c.in_obstacle,
                c.scan_found_more, c.between_degrees, c.failed_but_scanned / 4);
  return text;
}

}  // namespace elbowroom::test
