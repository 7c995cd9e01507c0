// SPDX-License-Identifier: MIT
#include "assets/generator/body_shape.h"

#include <algorithm>
#include <vector>

#include "assets/generator/figure.h"
#include "assets/generator/implicit.h"

namespace elbowroom::demo {

namespace {

const Vec3 kUp(0, 1, 0);
const Vec3 kLeft(1, 0, 0);

}  // namespace

// Modelled on the left; the right is its mirror image.
struct BodyShape::Data {
  Figure figure = make_figure();
  Vec3 at(const char* joint) const {
    return figure.joints[static_cast<std::size_t>(figure.find(joint))].position;
  }

  Vec3 shoulder = at("LeftUpperArm"), elbow = at("LeftLowerArm"), wrist = at("LeftHand");
  Vec3 hip = at("LeftUpperLeg"), knee = at("LeftLowerLeg"), ankle = at("LeftFoot");
  HandFrame hand = left_hand_frame();
  std::vector<Finger> fingers = left_fingers();

  // Sections along y: half width (x), half depth (z, negated: v = up × left = -z), shift.
  Loft torso{Vec3(0.0),
             kUp,
             kLeft,
             {{0.800, 0.060, 0.050, 0, 0.004},
              {0.830, 0.120, 0.086, 0, 0.006},
              {0.880, 0.161, 0.103, 0, 0.008},
              {0.930, 0.171, 0.109, 0, 0.012},
              {0.985, 0.164, 0.104, 0, 0.010},
              {1.050, 0.146, 0.096, 0, 0.000},
              {1.100, 0.138, 0.092, 0, -0.004},
              {1.150, 0.139, 0.093, 0, -0.005},
              {1.220, 0.151, 0.102, 0, -0.002},
              {1.290, 0.165, 0.111, 0, 0.004},
              {1.350, 0.172, 0.108, 0, 0.012},
              {1.400, 0.160, 0.094, 0, 0.020},
              {1.440, 0.120, 0.076, 0, 0.026},
              {1.475, 0.072, 0.058, 0, 0.028},
              {1.500, 0.050, 0.050, 0, 0.026}},
             0.25};

  Loft upper_arm = limb(shoulder, elbow,
                        {{-0.030, 0.038, 0.040},
                         {0.000, 0.0455, 0.0475, 0.000, 0.002},
                         {0.050, 0.0475, 0.0490, 0.001, 0.003},
                         {0.110, 0.0465, 0.0480, 0.003, 0.002},
                         {0.170, 0.0445, 0.0465, 0.003, 0.001},
                         {0.230, 0.0415, 0.0420},
                         {0.290, 0.0385, 0.0380},
                         {0.365, 0.0375, 0.0375}});
  Loft forearm = limb(elbow, wrist,
                      {{-0.040, 0.0375, 0.0375},
                       {0.020, 0.0390, 0.0390, 0.002, 0.000},
                       {0.060, 0.0410, 0.0400, 0.004, 0.000},
                       {0.110, 0.0375, 0.0360, 0.002, 0.000},
                       {0.170, 0.0305, 0.0310},
                       {0.225, 0.0255, 0.0280},
                       {0.275, 0.0210, 0.0280}});
  Loft palm{hand.wrist,
            hand.along,
            hand.thumb,
            {{-0.020, 0.0280, 0.0215},
             {0.012, 0.0300, 0.0200},
             {0.035, 0.0365, 0.0185, 0.001},
             {0.060, 0.0405, 0.0165, 0.001},
             {0.085, 0.0410, 0.0135, 0.001},
             {0.097, 0.0370, 0.0100, 0.002}},
            0.42};

  Loft thigh = limb(hip, knee,
                    {{-0.060, 0.062, 0.078, -0.004, 0.004},
                     {-0.010, 0.073, 0.090, -0.007, 0.004},
                     {0.060, 0.0735, 0.0900, -0.008, 0.000},
                     {0.140, 0.0710, 0.0850, -0.007, -0.004},
                     {0.230, 0.0650, 0.0765, -0.004, -0.006},
                     {0.320, 0.0575, 0.0660, -0.001, -0.006},
                     {0.390, 0.0535, 0.0580, 0, -0.002},
                     {0.475, 0.0500, 0.0530}});
  Loft shank = limb(knee, ankle,
                    {{-0.045, 0.0530, 0.0570},
                     {0.010, 0.0500, 0.0530, 0, 0.000},
                     {0.060, 0.0500, 0.0530, 0, 0.008},
                     {0.120, 0.0530, 0.0575, 0, 0.016},
                     {0.190, 0.0490, 0.0530, 0, 0.014},
                     {0.270, 0.0390, 0.0420, 0, 0.008},
                     {0.350, 0.0330, 0.0360, 0, 0.002},
                     {0.405, 0.0335, 0.0370},
                     {0.440, 0.0340, 0.0380}});

  // The shoe, along its own straight axis, toes a little out.
  Vec3 shoe_axis = glm::normalize(Vec3(0.10, 0, 1));
  Loft shoe{Vec3(ankle.x, 0.0, ankle.z),
            shoe_axis,
            Vec3(0, 1, 0),
            // u is up here: half height and its centre make a sole line that runs below the
            // ground, where the floor plane cuts it flat.
            {{-0.062, 0.020, 0.014, 0.026},
             {-0.054, 0.036, 0.026, 0.032},
             {-0.035, 0.052, 0.034, 0.038},
             {0.000, 0.060, 0.0365, 0.036},
             {0.040, 0.056, 0.0375, 0.030},
             {0.080, 0.046, 0.0430, 0.022},
             {0.120, 0.038, 0.0475, 0.018},
             {0.160, 0.032, 0.0450, 0.016},
             {0.185, 0.026, 0.0370, 0.015},
             {0.200, 0.018, 0.0250, 0.015},
             {0.207, 0.008, 0.0120, 0.015}},
            0.32};

  Bounds arm_bounds, hand_bounds, leg_bounds, head_bounds;

  Data() {
    for (const Vec3& p : {shoulder, elbow, wrist}) arm_bounds.add(p, 0.06);
    for (const Finger& f : fingers)
      for (const Vec3& p : f.points) hand_bounds.add(p, 0.02);
    hand_bounds.add(wrist, 0.05);
    for (const Vec3& p : {hip, knee, ankle}) leg_bounds.add(p, 0.10);
    leg_bounds.add(Vec3(0.12, 0.0, 0.2), 0.06);
    head_bounds.add(Vec3(0, 1.52, 0), 0.12);
    head_bounds.add(Vec3(0, 1.66, 0), 0.12);
  }

  // A loft down a limb whose u points to the body's middle and whose v points back.
  static Loft limb(const Vec3& from, const Vec3& to, std::vector<Section> sections) {
    const Vec3 axis = glm::normalize(to - from);
    const Vec3 ahead = glm::normalize(Vec3(0, 0, 1) - axis.z * axis);
    return Loft(from, axis, glm::cross(ahead, axis) * -1.0, std::move(sections));
  }

  double head(const Vec3& p) const {
    // A shop-window head: skull, face and jaw of one smooth egg; brow, nose and mouth only hinted
    // at, no eyes.
    double d = ellipsoid(p, {0, 1.668, -0.008}, {0.0740, 0.0820, 0.0935});
    d = smooth_union(d, ellipsoid(p, {0, 1.618, 0.020}, {0.0570, 0.0820, 0.0690}), 0.045);
    d = smooth_union(d, ellipsoid(p, {0, 1.5520, 0.060}, {0.024, 0.020, 0.024}), 0.050);
    // Corners of the jaw.
    d = smooth_union(d, ellipsoid(p, {0.044, 1.582, 0.010}, {0.014, 0.024, 0.026}), 0.040);
    // Sockets of the eyes, wide and shallow, so that brow and cheek show.
    d = smooth_intersection(d, -ellipsoid(p, {0.031, 1.6425, 0.112}, {0.026, 0.014, 0.026}), 0.032);
    // Nose: a soft ridge that widens to the tip.
    d = smooth_union(d, tapered_capsule(p, {0, 1.655, 0.082}, {0, 1.6085, 0.0990}, 0.0055, 0.0095),
                     0.022);
    // Mouth: a soft swell.
    d = smooth_union(d, ellipsoid(p, {0, 1.5740, 0.0740}, {0.024, 0.0130, 0.0110}), 0.022);
    // Ears, lying close.
    const Quat tilt = quat_from_rotation_vector(Vec3(0.0, 0.35, 0.12));
    const Vec3 ear = glm::conjugate(tilt) * (p - Vec3(0.0715, 1.630, -0.010));
    d = smooth_union(d, ellipsoid(ear, Vec3(0.0), {0.0075, 0.0270, 0.0160}), 0.016);
    return d;
  }

  // An ellipsoid and its mirror image, joined so that no seam shows in the middle.
  static double both(const Vec3& p, const Vec3& centre, const Vec3& radii) {
    return smooth_union(ellipsoid(p, centre, radii),
                        ellipsoid(p, Vec3(-centre.x, centre.y, centre.z), radii), 0.060);
  }

  double trunk(const Vec3& p) const {
    double d = torso(p);
    // Chest, shoulder blades, seat, the slope from the neck to the shoulder.
    d = smooth_union(d, both(p, {0.072, 1.330, 0.052}, {0.088, 0.070, 0.042}), 0.060);
    d = smooth_union(d, both(p, {0.080, 1.335, -0.092}, {0.075, 0.090, 0.030}), 0.070);
    d = smooth_union(d, ellipsoid(p, {0.074, 0.908, -0.070}, {0.084, 0.085, 0.060}), 0.060);
    // Cloth spans the cleft and the fork.
    d = smooth_union(d, ellipsoid(p, {0, 0.890, -0.050}, {0.060, 0.090, 0.070}), 0.050);
    d = smooth_union(d, ellipsoid(p, {0, 0.860, 0.020}, {0.060, 0.060, 0.065}), 0.050);
    d = smooth_union(
        d, tapered_capsule(p, {0.020, 1.490, -0.034}, {0.165, 1.428, -0.020}, 0.034, 0.043), 0.060);
    d = smooth_union(d, tapered_capsule(p, {0, 1.44, -0.034}, {0, 1.585, -0.012}, 0.060, 0.0535),
                     0.040);
    const double far = head_bounds.distance(p);
    if (far < 0.06 || far < d + 0.06) d = smooth_union(d, head(p), 0.024);
    return d;
  }

  double hand_shape(const Vec3& p) const {
    double palm_distance = palm(p);
    // Ball of the thumb and heel of the hand.
    palm_distance = smooth_union(
        palm_distance,
        tapered_capsule(p, fingers[0].points[0], fingers[0].points[1], 0.0165, 0.0125), 0.018);
    palm_distance = smooth_union(palm_distance,
                                 tapered_capsule(p, hand.point(0.022, -0.022, 0.007),
                                                 hand.point(0.055, -0.027, 0.004), 0.0130, 0.0120),
                                 0.014);
    double d = palm_distance;
    // Webs, which round off the corners between the fingers.
    for (std::size_t f = 1; f + 1 < fingers.size(); ++f)
      d = smooth_union(
          d,
          tapered_capsule(p, glm::mix(fingers[f].points[0], fingers[f].points[1], 0.36),
                          glm::mix(fingers[f + 1].points[0], fingers[f + 1].points[1], 0.36),
                          0.0062, 0.0062),
          0.008);
    for (std::size_t f = 0; f < fingers.size(); ++f) {
      const Finger& finger = fingers[f];
      double one = 1e9;
      for (std::size_t i = f == 0 ? 1 : 0; i < 3; ++i)
        one = smooth_union(one,
                           tapered_capsule(p, finger.points[i], finger.points[i + 1],
                                           finger.radius[i], finger.radius[i + 1]),
                           0.003);
      d = smooth_union(d, one, f == 0 ? 0.012 : 0.0080);
    }
    return d;
  }

  // One shape before the plane at `joint`, the other behind it, gradually over ± `width`: unlike a
  // union, no bulge where the two overlap.
  static double join(const Vec3& p, const Vec3& joint, const Vec3& direction, double width,
                     double before, double behind) {
    const double t = std::clamp(0.5 + 0.5 * glm::dot(p - joint, direction) / width, 0.0, 1.0);
    return glm::mix(before, behind, t * t * (3.0 - 2.0 * t));
  }

  double arm(const Vec3& p) const {
    const Vec3 along = glm::normalize(wrist - shoulder);
    double d = join(p, elbow, along, 0.035, upper_arm(p), forearm(p));
    // The round of the shoulder.
    d = smooth_union(
        d, ellipsoid(p, shoulder + Vec3(0.001, -0.002, 0.0), Vec3(0.043, 0.045, 0.047)), 0.030);
    // The point of the elbow.
    d = smooth_union(d, ellipsoid(p, elbow + Vec3(-0.004, -0.004, -0.026), Vec3(0.014)), 0.022);
    const double far = hand_bounds.distance(p);
    if (far < 0.04 || far < d + 0.04) d = join(p, wrist, hand.along, 0.016, d, hand_shape(p));
    return d;
  }

  double leg(const Vec3& p) const {
    double d = join(p, knee, Vec3(0, -1, 0), 0.040, thigh(p), shank(p));
    // Kneecap.
    d = smooth_union(d, ellipsoid(p, knee + Vec3(0, 0.006, 0.032), {0.030, 0.038, 0.024}), 0.025);
    const double cut = smooth_intersection(shoe(p), -p.y, 0.014);
    return smooth_union(d, cut, 0.022);
  }
};

BodyShape::BodyShape() : data_(std::make_unique<Data>()) {}
BodyShape::~BodyShape() = default;

double BodyShape::operator()(const Vec3& at) const {
  const Vec3 p(std::abs(at.x), at.y, at.z);
  const Data& body = *data_;
  double d = body.trunk(p);
  const double to_arm = std::min(body.arm_bounds.distance(p), body.hand_bounds.distance(p));
  if (to_arm < 0.07 || to_arm < d + 0.07) d = smooth_union(d, body.arm(p), 0.060);
  const double to_leg = body.leg_bounds.distance(p);
  if (to_leg < 0.06 || to_leg < d + 0.06) {
    double legs = body.leg(p);
    // The other leg too where the two meet, for a round fork without a seam.
    if (p.x < 0.06) legs = smooth_union(legs, body.leg(Vec3(-p.x, p.y, p.z)), 0.030);
    d = smooth_union(d, legs, 0.040);
  }
  return d;
}

Vec3 BodyShape::normal(const Vec3& p) const {
  constexpr double h = 2e-4;
  const Vec3 g((*this)(p + Vec3(h, 0, 0)) - (*this)(p - Vec3(h, 0, 0)),
               (*this)(p + Vec3(0, h, 0)) - (*this)(p - Vec3(0, h, 0)),
               (*this)(p + Vec3(0, 0, h)) - (*this)(p - Vec3(0, 0, h)));
  const double length = glm::length(g);
  return length > 1e-12 ? g / length : Vec3(0, 1, 0);
}

Vec3 BodyShape::project(Vec3 p) const {
  constexpr double h = 2e-4;
  for (int i = 0; i < 3; ++i) {
    const double f = (*this)(p);
    if (std::abs(f) < 1e-6) break;
    const Vec3 g = Vec3((*this)(p + Vec3(h, 0, 0)) - f, (*this)(p + Vec3(0, h, 0)) - f,
                        (*this)(p + Vec3(0, 0, h)) - f) /
                   h;
    p -= g * (f / std::max(glm::dot(g, g), 0.1));
  }
  return p;
}

BodyPart BodyShape::part(const Vec3& at) const {
  const Vec3 p(std::abs(at.x), at.y, at.z);
  const double trunk = data_->trunk(p), arm = data_->arm(p), leg = data_->leg(p);
  if (trunk <= arm && trunk <= leg) return BodyPart::trunk;
  return arm <= leg ? BodyPart::arm : BodyPart::leg;
}

double BodyShape::edge_length(const Vec3& at) const {
  const Vec3 p(std::abs(at.x), at.y, at.z);
  const Data& body = *data_;
  // Each place asks for a length in a ball and lets it grow outside by a fixed slope.
  double length = 0.0235;
  const auto wish = [&](const Vec3& centre, double radius, double fine, double slope) {
    length = std::min(length, fine + slope * std::max(0.0, glm::length(p - centre) - radius));
  };
  for (const Finger& f : body.fingers)
    for (int i = 1; i < 4; ++i) wish(f.points[i], 0.020, 0.0058, 0.15);
  for (std::size_t f = 1; f + 1 < body.fingers.size(); ++f)
    wish(glm::mix(body.fingers[f].points[0], body.fingers[f + 1].points[1], 0.5), 0.012, 0.0048,
         0.15);
  wish(body.hand.point(0.05, 0, 0), 0.045, 0.0085, 0.15);
  wish({0.0, 1.60, 0.095}, 0.050, 0.0072, 0.12);      // face
  wish({0.075, 1.628, -0.012}, 0.030, 0.0072, 0.12);  // ears
  wish({0.0, 1.64, 0.0}, 0.10, 0.0135, 0.15);
  wish(body.elbow, 0.05, 0.0135, 0.15);
  wish(body.knee, 0.06, 0.0165, 0.15);
  wish(body.shoulder, 0.08, 0.0175, 0.15);
  wish(body.hip, 0.10, 0.0185, 0.15);
  wish({body.ankle.x + 0.01, 0.03, 0.06}, 0.12, 0.0135, 0.15);
  // The edge of the sole.
  if (p.y < 0.05) length = std::min(length, 0.0095 + 0.15 * std::max(0.0, p.y - 0.015));
  return length;
}

}  // namespace elbowroom::demo
