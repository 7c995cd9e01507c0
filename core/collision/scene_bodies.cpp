// SPDX-License-Identifier: MIT
// What a scene is made of: the bodies of the character in view by limb segment, those of other
// characters and of objects, and which pairs of them are tested.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "core/collision/scene_collision_data.h"
#include "core/collision/surface_patches.h"

namespace elbowroom {
namespace {

using Data = SceneCollision::Data;

std::string owner_name(const Actor& actor) {
  return actor.name.empty() ? actor.model->path.filename().string() : actor.name;
}

// Nodes that the actor's clip moves, or that a skin drives: meshes below the same such node keep
// their places to each other.
std::vector<bool> moving_nodes(const Actor& actor) {
  std::vector<bool> moving(actor.model->skeleton.joints.size(), false);
  if (actor.clip)
    for (const Channel& channel : actor.clip->channels)
      if (channel.joint >= 0 && static_cast<std::size_t>(channel.joint) < moving.size() &&
          channel.path != Path::weights)
        moving[static_cast<std::size_t>(channel.joint)] = true;
  for (const Character& character : actor.model->characters)
    for (const int joint : character.joints) moving[static_cast<std::size_t>(joint)] = true;
  return moving;
}

// The nearest moving node at or above `node`, else the topmost one.
int frame_of(const Skeleton& skeleton, const std::vector<bool>& moving, int node) {
  while (!moving[static_cast<std::size_t>(node)] &&
         skeleton.joints[static_cast<std::size_t>(node)].parent >= 0)
    node = skeleton.joints[static_cast<std::size_t>(node)].parent;
  return node;
}

struct Builder {
  Data& data;
  std::map<std::string, int> part_numbers;

  int part(const std::string& name) {
    const auto [at, fresh] = part_numbers.try_emplace(name, static_cast<int>(data.parts.size()));
    if (fresh) data.parts.push_back(name);
    return at->second;
  }

  Status add(int actor, bool deforms, int frame, std::vector<BodyTriangle> triangles,
             const ActorState& state, const BodyRole& role) {
    if (triangles.empty()) return Done{};
    auto body = CollisionBody::build(data.world.actors[static_cast<std::size_t>(actor)], actor,
                                     deforms, frame, std::move(triangles), state,
                                     data.settings.patch_size * data.height, data.weld_tolerance());
    if (!body) return body.error();
    data.bodies.push_back(std::move(body).value());
    data.roles.push_back(role);
    return Done{};
  }

  // The skin by limb segment, and rigid meshes by the joint they hang from.
  Status add_character(int actor_index, int character_index, bool own, int entity) {
    const Actor& actor = data.world.actors[static_cast<std::size_t>(actor_index)];
    const Model& model = *actor.model;
    const Character& character = model.characters[static_cast<std::size_t>(character_index)];
    const std::string owner = character.name.empty() ? owner_name(actor) : character.name;
    std::vector<bool> moving = moving_nodes(actor);
    if (own)
      for (const LimbModel& limb : data.limbs)
        for (const FollowingJoint& joint : limb.limb.following)
          moving[static_cast<std::size_t>(joint.joint)] = true;
    // Keys: is it rigid, whose side, which frame.
    using Key = std::tuple<bool, int, int, int>;
    std::map<Key, std::vector<BodyTriangle>> pieces;
    for (const int m : character.meshes) {
      const Mesh& mesh = model.meshes[static_cast<std::size_t>(m)];
      const bool rigid = mesh.skin < 0;
      const std::vector<int> joints = joints_of_triangles(mesh);
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
        const int joint = rigid ? frame_of(model.skeleton, moving, joints[t]) : joints[t];
        const LimbSide side = own ? data.side_of_node[static_cast<std::size_t>(joint)] : LimbSide{};
        BodyTriangle triangle{m, t, 0, joint};
        triangle.part = part(rigid ? mesh_part_name(owner, model, m)
                                   : joint_part_name(owner, model.skeleton, joint));
        pieces[{rigid, side.limb, side.segment, rigid ? joint : -1}].push_back(triangle);
      }
    }
    // Own pieces are cut in the bind pose, which is what patches, seams and radii are stated in.
    ActorState bind;
    if (own) bind = bind_state(data.world, actor_index, character_index);
    const ActorState& state = own ? bind : data.states[static_cast<std::size_t>(actor_index)];
    for (auto& [key, triangles] : pieces) {
      const auto& [rigid, limb, segment, frame] = key;
      BodyRole role;
      role.own = own;
      role.side = {limb, segment};
      role.entity = entity;
      role.animated = true;
      if (const Status added = add(actor_index, !rigid, frame, std::move(triangles), state, role);
          !added)
        return added;
    }
    return Done{};
  }

  // An object's meshes by the node that moves them. Where all of the character in view stands
  // inside the object's box, the object may be a room: its walls are to be run into, but being
  // within them is no collision. One triangle of each connected surface is then kept apart as a
  // lid, so that no surface encloses anything.
  Status add_object(int actor_index, const Object& object, int entity, const Box& character) {
    const Actor& actor = data.world.actors[static_cast<std::size_t>(actor_index)];
    const Model& model = *actor.model;
    const ActorState& state = data.states[static_cast<std::size_t>(actor_index)];
    const std::vector<bool> moving = moving_nodes(actor);
    std::map<int, std::vector<BodyTriangle>> pieces;
    for (const int m : object.meshes) {
      const Mesh& mesh = model.meshes[static_cast<std::size_t>(m)];
      const int frame = frame_of(model.skeleton, moving, mesh.node);
      const int number = part(mesh_part_name(owner_name(actor), model, m));
      for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
        pieces[frame].push_back({m, t, number, mesh.node});
    }
    BodyRole role;
    role.entity = entity;
    role.animated = object.animated || actor.attachment.has_value();
    for (auto& [frame, triangles] : pieces) {
      std::vector<BodyTriangle> again = triangles;
      if (const Status added = add(actor_index, false, frame, std::move(triangles), state, role);
          !added)
        return added;
      CollisionBody& body = data.bodies.back();
      body.place(state, data.origin);
      const Box& box = body.box();
      const bool around = !character.empty() &&
                          glm::all(glm::lessThanEqual(box.low, character.low)) &&
                          glm::all(glm::greaterThanEqual(box.high, character.high));
      if (!around) continue;
      // In the body's order, which is the order of its mesh's triangles.
      again = body.triangles();
      const std::vector<Vec3> positions(body.mesh().positions().begin(),
                                        body.mesh().positions().end());
      const WeldedSurface surface = weld(positions, body.mesh().triangles(), data.weld_tolerance());
      const std::vector<int> component = connected_components(surface);
      std::set<int> seen;
      std::vector<BodyTriangle> walls, lids;
      for (std::size_t t = 0; t < again.size(); ++t)
        (seen.insert(component[surface.triangles[t].x]).second ? lids : walls).push_back(again[t]);
      data.bodies.pop_back();
      data.roles.pop_back();
      for (auto* half : {&walls, &lids})
        if (const Status added = add(actor_index, false, frame, std::move(*half), state, role);
            !added)
          return added;
    }
    return Done{};
  }
};

}  // namespace

ActorState bind_state(const World& world, int actor, int character) {
  const Actor& self = world.actors[static_cast<std::size_t>(actor)];
  ActorState bind{
      rest_pose(self.model->skeleton),
      bind_globals(*self.model, self.model->characters[static_cast<std::size_t>(character)])};
  for (Mat4& m : bind.world_from_joint) m = self.world_from_file * m;
  return bind;
}

Status build_bodies(Data& data) {
  Builder builder{data, {}};
  const Actor& view = data.world.actors[static_cast<std::size_t>(data.actor)];
  std::vector<Limb> limbs;
  for (const LimbModel& limb : data.limbs) limbs.push_back(limb.limb);
  data.side_of_node = limb_sides(view.model->skeleton, limbs);
  data.limb_within.assign(limbs.size(), std::vector<bool>(limbs.size(), false));
  for (std::size_t l = 0; l < limbs.size(); ++l)
    for (int at = static_cast<int>(l), steps = 0;
         at >= 0 && steps <= static_cast<int>(limbs.size());
         at = enclosing_limb(view.model->skeleton, limbs, at), ++steps)
      data.limb_within[l][static_cast<std::size_t>(at)] = true;

  int entity = 0;
  const int own_entity = entity++;
  if (const Status added = builder.add_character(data.actor, data.character, true, own_entity);
      !added)
    return added;

  // The whole skin, with parts of the same numbers.
  std::vector<BodyTriangle> skin;
  for (std::size_t b = 0; b < data.bodies.size(); ++b)
    if (data.bodies[b].deforms())
      skin.insert(skin.end(), data.bodies[b].triangles().begin(), data.bodies[b].triangles().end());
  if (!skin.empty()) {
    auto whole =
        CollisionBody::build(view, data.actor, true, -1, std::move(skin),
                             bind_state(data.world, data.actor, data.character),
                             data.settings.patch_size * data.height, data.weld_tolerance());
    if (!whole) return whole.error();
    data.whole_skin = std::make_unique<CollisionBody>(std::move(whole).value());
  }

  // Where the character stands at the clip's beginning says what it is inside of.
  Box whole{Vec3(1.0), Vec3(-1.0)};
  data.body_stamp.assign(data.bodies.size(), 0);
  data.pose(data.begin);
  for (std::size_t b = 0; b < data.bodies.size(); ++b) {
    const Box& box = data.placed(static_cast<int>(b)).box();
    if (box.empty()) continue;
    whole = whole.empty() ? box : Box{glm::min(whole.low, box.low), glm::max(whole.high, box.high)};
  }
  for (std::size_t i = 0; i < data.world.actors.size(); ++i) {
    const Actor& actor = data.world.actors[i];
    if (!actor.model) continue;
    const int index = static_cast<int>(i);
    for (std::size_t c = 0; c < actor.model->characters.size(); ++c) {
      if (index == data.actor && static_cast<int>(c) == data.character) continue;
      if (const Status added = builder.add_character(index, static_cast<int>(c), false, entity++);
          !added)
        return added;
    }
    for (const Object& object : actor.model->objects)
      if (const Status added = builder.add_object(index, object, entity++, whole); !added)
        return added;
  }
  data.body_stamp.assign(data.bodies.size(), 0);
  data.posed = false;
  return Done{};
}

PairList& Data::pairs_now() {
  // What is carried now, and by which side: attachments may begin and end, and hang on each other.
  std::vector<LimbSide> side(world.actors.size(), {-1, kNotCarried});
  std::vector<int> key;
  for (std::size_t i = 0; i < world.actors.size(); ++i) {
    const auto& attachment = world.actors[i].attachment;
    const bool holds = attachment && attachment->begin <= posed_at && posed_at <= attachment->end &&
                       attachment->actor >= 0 && attachment->actor < static_cast<int>(i) &&
                       static_cast<int>(i) != actor;
    if (holds) {
      if (attachment->actor != actor) {
        side[i] = side[static_cast<std::size_t>(attachment->actor)];
      } else if (attachment->joint >= 0 &&
                 static_cast<std::size_t>(attachment->joint) < side_of_node.size()) {
        side[i] = side_of_node[static_cast<std::size_t>(attachment->joint)];
      }
    }
    key.push_back(side[i].limb);
    key.push_back(side[i].segment);
    key.push_back(holds ? 1 : 0);
  }
  const auto [at, fresh] = pair_lists.try_emplace(std::move(key));
  PairList& list = at->second;
  if (!fresh) return list;
  list.side_of_actor = side;

  const int count = static_cast<int>(bodies.size());
  for (int a = 0; a < count; ++a)
    for (int b = a + 1; b < count; ++b) {
      const BodyRole &ra = roles[static_cast<std::size_t>(a)],
                     &rb = roles[static_cast<std::size_t>(b)];
      const CollisionBody &ba = bodies[static_cast<std::size_t>(a)],
                          &bb = bodies[static_cast<std::size_t>(b)];
      const auto side_of = [&](const BodyRole& role, const CollisionBody& body) {
        if (role.own || body.actor() == actor) return role.side;
        return side[static_cast<std::size_t>(body.actor())];
      };
      const LimbSide sa = side_of(ra, ba), sb = side_of(rb, bb);
      const bool carried_a = !ra.own && sa.segment != kNotCarried && ba.actor() != actor;
      const bool carried_b = !rb.own && sb.segment != kNotCarried && bb.actor() != actor;
      if (ra.entity == rb.entity && !ra.own) continue;
      TestPair pair;
      pair.a = a;
      pair.b = b;
      pair.limb_a = sa.limb;
      pair.limb_b = sb.limb;
      if (sa.limb < 0 && sb.limb < 0) {
        // Other contacts: whatever may move against something else. What rides on the character is
        // not set against it, nor things that hang together against each other.
        const bool with_a = ra.own || carried_a, with_b = rb.own || carried_b;
        if (with_a && with_b) continue;
        if (!ra.animated && !rb.animated && !ra.own && !rb.own) continue;
        const auto follows = [&](const CollisionBody& x, const CollisionBody& y) {
          const auto& attachment = world.actors[static_cast<std::size_t>(x.actor())].attachment;
          return attachment && attachment->actor == y.actor();
        };
        if (ba.actor() != bb.actor() && (follows(ba, bb) || follows(bb, ba))) continue;
      } else if (sa.limb == sb.limb && sa.segment == sb.segment) {
        // One segment moves as one, but a holder's fingers may close on what it carries.
        if (carried_a == carried_b) continue;
      }
      // A carried thing may touch the segment that holds it and what hangs below that; nothing
      // else.
      const auto held_by = [&](const LimbSide& thing, const BodyRole& holder,
                               const LimbSide& at_side) {
        return holder.own && at_side.limb == thing.limb && thing.limb >= 0 &&
               at_side.segment >= thing.segment;
      };
      pair.clip_may_allow = (ra.own && rb.own) ||
                            (carried_a && !carried_b && held_by(sa, rb, sb)) ||
                            (carried_b && !carried_a && held_by(sb, ra, sa));
      if (pair.clip_may_allow) {
        const auto [entry, made] =
            allowed_pairs.try_emplace(std::pair(a, b), ba.patch_count(), bb.patch_count());
        (void)made;
        pair.allowed = &entry->second;
      }
      list.pairs.push_back(pair);
    }
  return list;
}

}  // namespace elbowroom
