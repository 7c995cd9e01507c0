// SPDX-License-Identifier: MIT
// Things wholly inside a skin: a needle along the arm's bones crosses no skin, and none of the
// pieces the skin is cut into encloses it alone.
#include <cstddef>
#include <limits>

#include "core/collision/scene_collision_data.h"
#include "core/collision/triangle_predicates.h"

namespace elbowroom {

std::vector<EnclosedObject> enclosed_objects(SceneCollision::Data& data, int only_limb) {
  std::vector<EnclosedObject> found;
  if (!data.whole_skin) return found;
  Box skin{Vec3(1.0), Vec3(-1.0)};
  for (std::size_t b = 0; b < data.bodies.size(); ++b) {
    if (!data.roles[b].own || !data.bodies[b].deforms()) continue;
    const Box& box = data.placed(static_cast<int>(b)).box();
    if (box.empty()) continue;
    skin = skin.empty() ? box : Box{glm::min(skin.low, box.low), glm::max(skin.high, box.high)};
  }
  const auto& side_of_actor = data.pairs_now().side_of_actor;
  std::vector<TriangleContact> contacts;
  for (std::size_t b = 0; b < data.bodies.size(); ++b) {
    if (data.roles[b].own) continue;
    const int owner = data.bodies[b].actor();
    if (side_of_actor[static_cast<std::size_t>(owner)].segment != kNotCarried) continue;
    const CollisionBody& object = data.placed(static_cast<int>(b));
    const Box& box = object.box();
    // Boxes settle nearly all of it: most things are larger than a body, or elsewhere.
    if (box.empty() || skin.empty() || glm::any(glm::lessThan(box.low, skin.low)) ||
        glm::any(glm::greaterThan(box.high, skin.high)))
      continue;
    CollisionBody& whole = *data.whole_skin;
    if (data.whole_stamp != data.stamp) {
      whole.place(data.states[static_cast<std::size_t>(data.actor)], data.origin);
      data.whole_stamp = data.stamp;
    }
    find_contacts(whole.mesh(), object.mesh(), object.query_from_body(), 0.0, {}, contacts);
    for (const TriangleContact& contact : contacts) {
      if (!contact.contained) continue;
      // The skin nearest to it says which part it is in.
      EnclosedObject enclosed;
      enclosed.body = static_cast<int>(b);
      enclosed.place = contact.place;
      enclosed.object_part = object.triangles()[contact.triangle_b].part;
      double nearest = std::numeric_limits<double>::infinity();
      const auto positions = whole.mesh().positions();
      for (std::size_t t = 0; t < whole.triangles().size(); ++t) {
        const glm::uvec3& corner = whole.mesh().triangles()[t];
        const double distance = glm::distance(
            contact.place,
            closest_point(contact.place, {Vec3(positions[corner.x]), Vec3(positions[corner.y]),
                                          Vec3(positions[corner.z])}));
        if (distance >= nearest) continue;
        nearest = distance;
        enclosed.part = whole.triangles()[t].part;
        enclosed.limb =
            data.side_of_node[static_cast<std::size_t>(whole.triangles()[t].joint)].limb;
      }
      enclosed.depth = nearest;
      if (only_limb < 0 || data.in_limb(enclosed.limb, only_limb)) found.push_back(enclosed);
      break;  // one place tells of the object
    }
  }
  return found;
}

ContactSample enclosed_sample(const SceneCollision::Data& data, const EnclosedObject& object,
                              int only_limb) {
  ContactSample sample;
  sample.limb = only_limb >= 0 ? only_limb : object.limb;
  sample.part_a = data.parts[static_cast<std::size_t>(object.part)];
  sample.part_b = data.parts[static_cast<std::size_t>(object.object_part)];
  sample.place = object.place + data.origin;
  sample.depth = object.depth;
  return sample;
}

}  // namespace elbowroom
