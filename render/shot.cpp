// SPDX-License-Identifier: MIT
#include "render/shot.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace elbowroom {
namespace {

// What is to be seen at one time, over all worlds.
struct Moment {
  std::vector<Vec3> figure;     // points of the figure and what it carries
  std::vector<Vec3> obstacles;  // corners of what is near it
  std::vector<Vec3> contacts;
  Vec3 centre{0.0};  // mean of the figure's points
};

bool finite(const Vec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// Meshes that belong to the figure in this actor: the character's own, and all of props that it
// carries.
std::vector<int> figure_meshes(const World& world, std::size_t actor, const ShotRequest& request) {
  const Actor& candidate = world.actors[actor];
  std::vector<int> all;
  for (std::size_t m = 0; candidate.model && m < candidate.model->meshes.size(); ++m) {
    all.push_back(static_cast<int>(m));
  }
  if (candidate.attachment) return all;
  if (static_cast<int>(actor) != request.actor || !candidate.model) return {};
  const auto& characters = candidate.model->characters;
  if (characters.empty()) return all;
  const int last = static_cast<int>(characters.size()) - 1;
  return characters[static_cast<std::size_t>(std::clamp(request.character, 0, last))].meshes;
}

// Adds the box of those triangles of `meshes` that reach into `region`, cut to it. Triangles that
// lie on the ground say nothing about the picture.
void add_near_parts(const Actor& actor, const ActorState& state, const std::vector<int>& meshes,
                    const Bounds& region, double ground, double size, std::vector<Vec3>& out) {
  std::vector<Vec3> points;
  for (const int m : meshes) {
    const Mesh& mesh = actor.model->meshes[static_cast<std::size_t>(m)];
    deform(*actor.model, mesh, state.pose, state.world_from_joint, points);
    Bounds near;
    for (const auto& triangle : mesh.triangles) {
      Bounds box;
      bool sound = true;
      for (int k = 0; k < 3; ++k) {
        sound = sound && triangle[k] < points.size() && finite(points[triangle[k]]);
        if (sound) box.add(points[triangle[k]]);
      }
      if (!sound || box.upper.y < ground + 0.02 * size) continue;
      Bounds part;
      part.lower = glm::max(box.lower, region.lower);
      part.upper = glm::min(box.upper, region.upper);
      const Vec3 e = part.upper - part.lower;
      if (e.x >= 0 && e.y >= 0 && e.z >= 0) near.add(part);
    }
    if (near.empty()) continue;
    for (int i = 0; i < 8; ++i) {
      out.emplace_back((i & 1) ? near.upper.x : near.lower.x, (i & 2) ? near.upper.y : near.lower.y,
                       (i & 4) ? near.upper.z : near.lower.z);
    }
  }
}

Moment look_at(const ShotRequest& request, std::size_t index, double size) {
  Moment moment;
  std::vector<ActorState> states;
  for (const World* world : request.worlds) {
    world_state_at(*world, request.times[index], states);
    const std::size_t first = moment.figure.size();
    for (std::size_t a = 0; a < world->actors.size(); ++a) {
      const auto meshes = figure_meshes(*world, a, request);
      body_points(world->actors[a], states[a], meshes, 1500, moment.figure);
    }
    Bounds region;
    for (std::size_t i = first; i < moment.figure.size(); ++i) region.add(moment.figure[i]);
    if (region.empty()) continue;
    const double ground = region.lower.y;
    region.lower -= Vec3(0.12, 0.0, 0.12) * size;
    region.upper += Vec3(0.12, 0.05, 0.12) * size;
    for (std::size_t a = 0; a < world->actors.size(); ++a) {
      if (!world->actors[a].model) continue;
      const auto own = figure_meshes(*world, a, request);
      std::vector<int> others;
      for (std::size_t m = 0; m < world->actors[a].model->meshes.size(); ++m) {
        if (std::find(own.begin(), own.end(), static_cast<int>(m)) == own.end()) {
          others.push_back(static_cast<int>(m));
        }
      }
      add_near_parts(world->actors[a], states[a], others, region, ground, size, moment.obstacles);
    }
  }
  if (index < request.contacts.size()) {
    for (const auto& place : request.contacts[index]) {
      if (finite(place)) moment.contacts.push_back(place);
    }
  }
  for (const auto& p : moment.figure) moment.centre += p;
  if (!moment.figure.empty()) moment.centre /= static_cast<double>(moment.figure.size());
  return moment;
}

// How well a camera shows the action: pixels of the limb (of the figure, if no limb is given), and
// the part of the contacts that nothing hides.
struct Visibility {
  double limb = 0, figure = 0, contacts = 1;
};

// True if the triangle mostly follows one of the marked nodes.
bool is_marked(const Mesh& mesh, int triangle, const std::vector<char>& marked) {
  if (triangle < 0 || triangle >= static_cast<int>(mesh.triangles.size())) return false;
  const auto is = [&](int node) {
    return node >= 0 && node < static_cast<int>(marked.size()) &&
           marked[static_cast<std::size_t>(node)] != 0;
  };
  if (mesh.skin < 0) return is(mesh.node);
  double weight = 0;
  for (int k = 0; k < 3; ++k) {
    const auto v = mesh.triangles[static_cast<std::size_t>(triangle)][k];
    if (v + 1 >= mesh.influence_begin.size()) return false;
    for (auto i = mesh.influence_begin[v]; i < mesh.influence_begin[v + 1]; ++i) {
      if (is(mesh.influences[i].joint)) weight += double{mesh.influences[i].weight};
    }
  }
  return weight > 1.5;
}

Visibility measure(const std::vector<Pick>& picks, int side, const Camera& camera,
                   const World& world, const ShotRequest& request, const std::vector<char>& marked,
                   const std::vector<Vec3>& contacts, double size) {
  Visibility seen;
  std::vector<std::vector<int>> figure;
  for (std::size_t a = 0; a < world.actors.size(); ++a) {
    figure.push_back(figure_meshes(world, a, request));
  }
  for (const auto& pick : picks) {
    if (!pick.hit()) continue;
    const auto& own = figure[static_cast<std::size_t>(pick.actor)];
    if (std::find(own.begin(), own.end(), pick.mesh) == own.end()) continue;
    const Actor& actor = world.actors[static_cast<std::size_t>(pick.actor)];
    if (!actor.attachment) seen.figure += 1;
    const Mesh& mesh = actor.model->meshes[static_cast<std::size_t>(pick.mesh)];
    if (actor.attachment ||
        (pick.actor == request.actor && is_marked(mesh, pick.triangle, marked))) {
      seen.limb += 1;
    }
  }
  if (contacts.empty()) return seen;
  double open = 0;
  for (const auto& place : contacts) {
    const Vec3 at = project(camera, 1.0, place);
    const int x = static_cast<int>(std::floor(at.x * side));
    const int y = static_cast<int>(std::floor(at.y * side));
    if (at.z <= 0 || x < 0 || y < 0 || x >= side || y >= side) continue;
    const Pick& pick = picks[static_cast<std::size_t>(y * side + x)];
    const double before = pick.hit() ? glm::dot(pick.place - place, camera.backward()) : 0.0;
    // Surfaces about a contact lie before it by a limb's thickness at most.
    open += before < 0.06 * size ? 1.0 : 0.0;
  }
  seen.contacts = open / static_cast<double>(contacts.size());
  return seen;
}

// The way the toes point, horizontal, in the world: in the bind pose, from the ankles to what
// stands on the ground about them, then turned as the figure's topmost joint is turned at that
// time. Nothing if the feet do not say: a human's soles lie 3 to 8 % of its height ahead of its
// ankles.
std::optional<Vec3> toes(const World& world, const ShotRequest& request, double t) {
  const auto a = static_cast<std::size_t>(std::max(request.actor, 0));
  if (a >= world.actors.size() || !world.actors[a].model) return std::nullopt;
  const Model& model = *world.actors[a].model;
  if (model.characters.empty()) return std::nullopt;
  const int last = static_cast<int>(model.characters.size()) - 1;
  const Character& figure =
      model.characters[static_cast<std::size_t>(std::clamp(request.character, 0, last))];
  ActorState bind{rest_pose(model.skeleton), bind_globals(model, figure)};
  std::vector<Vec3> points, soles;
  body_points(world.actors[a], bind, figure.meshes, 2000, points);
  double lowest = std::numeric_limits<double>::infinity();
  for (const auto& p : points) lowest = std::min(lowest, p.y);
  Vec3 sole(0.0), ankle(0.0);
  for (const auto& p : points) {
    if (p.y < lowest + 0.03 * figure.height) soles.push_back(p), sole += p;
  }
  double ankles = 0;
  for (const auto& p : points) {
    const double height = (p.y - lowest) / figure.height;
    if (!(height > 0.06 && height < 0.13)) continue;
    // Hands that hang low are no ankles.
    const bool above_sole = std::any_of(soles.begin(), soles.end(), [&](const Vec3& q) {
      return std::hypot(p.x - q.x, p.z - q.z) < 0.04 * figure.height;
    });
    if (above_sole) ankle += p, ankles += 1;
  }
  if (soles.empty() || ankles == 0) return std::nullopt;
  Vec3 way = (sole / static_cast<double>(soles.size()) - ankle / ankles) / figure.height;
  way.y = 0;
  const double ahead = glm::length(way);
  if (!(ahead > 0.03 && ahead < 0.08)) return std::nullopt;

  std::vector<ActorState> states;
  world_state_at(world, t, states);
  for (const int joint : model.skeleton.order) {
    if (!std::binary_search(figure.joints.begin(), figure.joints.end(), joint)) continue;
    const auto j = static_cast<std::size_t>(joint);
    way = rotation_of(states[a].world_from_joint[j]) *
          (glm::conjugate(rotation_of(bind.world_from_joint[j])) * way);
    break;
  }
  way.y = 0;
  if (!finite(way) || glm::length(way) < 0.5 * ahead) return std::nullopt;
  return way;
}

// The way the figure faces, as a camera azimuth: as told, else where it goes to, else where its
// toes point, else +z of its file.
double facing(const ShotRequest& request, const std::vector<Moment>& moments, double size) {
  const auto azimuth = [](const Vec3& way) { return std::atan2(way.x, way.z); };
  if (request.forward && finite(*request.forward) &&
      std::hypot(request.forward->x, request.forward->z) > 0) {
    return azimuth(*request.forward);
  }
  const Vec3 way = moments.back().centre - moments.front().centre;
  if (std::hypot(way.x, way.z) > 0.35 * size) return azimuth(way);
  if (const auto pointed = toes(*request.worlds.front(), request, request.times.front())) {
    return azimuth(*pointed);
  }
  const auto& actors = request.worlds.front()->actors;
  const auto index = static_cast<std::size_t>(std::max(request.actor, 0));
  if (index >= actors.size()) return 0;
  const Vec3 z = Vec3(actors[index].world_from_file[2]);
  return finite(z) && std::hypot(z.x, z.z) > 0 ? azimuth(z) : 0;
}

struct Angles {
  double azimuth, elevation, liking;
};

std::vector<Angles> directions(const ShotRequest& request, double front) {
  const double elevation = request.elevation.value_or(glm::radians(10.0));
  if (request.azimuth) return {{*request.azimuth, elevation, 1}};
  const double likings[][2] = {{35, 1.0},  {52, 1.0},  {20, 0.9}, {68, 0.9},
                               {85, 0.78}, {120, 0.5}, {150, 0.4}};
  std::vector<Angles> out;
  for (const auto& [degrees, liking] : likings) {
    for (const double side : {1.0, -1.0}) {
      out.push_back({front + side * glm::radians(degrees), elevation, liking});
    }
  }
  return out;
}

std::vector<Angles> heights(const ShotRequest& request, double azimuth) {
  if (request.elevation) return {{azimuth, *request.elevation, 1}};
  return {{azimuth, glm::radians(10.0), 1.0},
          {azimuth, glm::radians(4.0), 0.97},
          {azimuth, glm::radians(20.0), 0.9}};
}

// Up to `count` of these, evenly spread.
std::vector<std::size_t> spread(const std::vector<std::size_t>& from, std::size_t count) {
  std::vector<std::size_t> chosen;
  count = std::min(count, from.size());
  for (std::size_t k = 0; k < count; ++k) {
    chosen.push_back(from[(2 * k + 1) * from.size() / (2 * count)]);
  }
  return chosen;
}

// The times that decide on the view: some with contacts and some without, four in all.
std::vector<std::size_t> telling_moments(const std::vector<Moment>& moments) {
  std::vector<std::size_t> with, without;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    (moments[i].contacts.empty() ? without : with).push_back(i);
  }
  std::vector<std::size_t> chosen = spread(with, without.empty() ? 4 : 2);
  for (const auto i : spread(without, 4 - chosen.size())) chosen.push_back(i);
  return chosen;
}

}  // namespace

Shot plan_shot(SceneRenderer& renderer, const ShotRequest& request, double aspect) {
  Shot shot;
  const World& world = *request.worlds.front();
  shot.size = scene_size(world);
  std::vector<Moment> moments;
  for (std::size_t i = 0; i < request.times.size(); ++i) {
    moments.push_back(look_at(request, i, shot.size));
  }
  Bounds standing;
  for (const auto& moment : moments) {
    for (const auto& p : moment.figure) standing.add(p);
  }
  if (!standing.empty() && std::abs(standing.lower.y) > 0.25 * shot.size) {
    shot.ground = standing.lower.y;
  }

  double travel = 0;
  for (const auto& moment : moments) {
    const Vec3 way = moment.centre - moments.front().centre;
    travel = std::max(travel, std::hypot(way.x, way.z));
  }
  shot.follows = request.move == CameraMove::follow ||
                 (request.move == CameraMove::automatic && travel > 0.9 * shot.size);
  if (request.focus) shot.follows = request.move == CameraMove::follow;
  const auto shift = [&](std::size_t i) {
    const Vec3 way = moments[i].centre - moments.front().centre;
    return shot.follows ? Vec3(way.x, 0, way.z) : Vec3(0.0);
  };

  // All that is to be seen, as the first time's camera sees it.
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < moments.size(); ++i) {
    for (const auto* part : {&moments[i].figure, &moments[i].obstacles, &moments[i].contacts}) {
      for (const auto& p : *part) points.push_back(p - shift(i));
    }
  }
  const bool close = request.focus && finite(*request.focus);
  const double radius = request.extent > 0 ? request.extent : 0.45 * shot.size;
  if (close) {
    points.clear();
    for (int i = 0; i < 6; ++i) {
      Vec3 step(0.0);
      step[i / 2] = (i & 1) ? radius : -radius;
      points.push_back(*request.focus + step);
    }
  }

  std::vector<char> marked;
  const auto actor = static_cast<std::size_t>(std::max(request.actor, 0));
  if (actor < world.actors.size() && world.actors[actor].model) {
    marked.resize(world.actors[actor].model->skeleton.joints.size(), 0);
    for (const int node : request.limb) {
      if (node >= 0 && node < static_cast<int>(marked.size())) {
        marked[static_cast<std::size_t>(node)] = 1;
      }
    }
  }

  const auto telling = telling_moments(moments);
  double with_contacts = 0;
  for (const auto i : telling) with_contacts += moments[i].contacts.empty() ? 0.0 : 1.0;
  Camera camera;
  camera.field_of_view = request.field_of_view;
  const auto look_from = [&](const Angles& angles) {
    constexpr int kSide = 128;
    camera.azimuth = angles.azimuth;
    camera.elevation = angles.elevation;
    const Camera whole = framed(camera, points, 1.0, request.margin);
    std::vector<ActorState> states;
    Frame frame;
    frame.world = &world;
    frame.states = &states;
    frame.size = shot.size;
    Visibility seen{0, 0, with_contacts > 0 ? 0.0 : 1.0};
    for (const auto i : telling) {
      Camera moved = whole;
      moved.focus += shift(i);
      world_state_at(world, request.times[i], states);
      const auto picks = renderer.pick_all(frame, moved, {kSide, kSide});
      const auto now =
          measure(picks, kSide, moved, world, request, marked, moments[i].contacts, shot.size);
      seen.limb += now.limb;
      seen.figure += now.figure;
      if (!moments[i].contacts.empty()) seen.contacts += now.contacts / with_contacts;
    }
    return seen;
  };
  // First the side, then how high: a product of both would cost three times as many pictures.
  const auto best_of = [&](const std::vector<Angles>& choices) {
    if (choices.size() == 1) return choices.front();
    std::vector<Visibility> seen;
    double most_limb = 1, most_figure = 1;  // a pixel at least
    for (const auto& angles : choices) {
      seen.push_back(look_from(angles));
      most_limb = std::max(most_limb, seen.back().limb);
      most_figure = std::max(most_figure, seen.back().figure);
    }
    std::size_t best = 0;
    double best_score = -1;
    for (std::size_t c = 0; c < choices.size(); ++c) {
      const double score = choices[c].liking * (0.2 + 0.8 * seen[c].contacts) *
                           (0.45 + 0.55 * seen[c].limb / most_limb) *
                           (0.35 + 0.65 * seen[c].figure / most_figure);
      if (score > best_score + 1e-9) {
        best_score = score;
        best = c;
      }
    }
    return choices[best];
  };
  const Angles side = best_of(directions(request, facing(request, moments, shot.size)));
  const Angles chosen = best_of(heights(request, side.azimuth));
  camera.azimuth = chosen.azimuth;
  camera.elevation = chosen.elevation;
  camera = sanitized(camera);

  if (!(aspect > 0) || !std::isfinite(aspect)) {
    Bounds flat;
    for (const auto& p : points) {
      flat.add(Vec3(glm::dot(p, camera.right()), glm::dot(p, camera.up()), 0.0));
    }
    const Vec3 extent = flat.extent();
    aspect = extent.y > 0 ? std::clamp(extent.x / extent.y * 1.08, 0.62, 1.7) : 1.0;
  }
  shot.aspect = aspect;
  Camera first = framed(camera, points, aspect, request.margin);
  if (close) {
    // The sphere of that radius about the focus just fits.
    const double tangent = std::tan(0.5 * camera.field_of_view) * (1.0 - request.margin);
    first.focus = *request.focus;
    first.distance = radius / std::sin(std::atan(tangent * std::min(aspect, 1.0)));
  }
  for (std::size_t i = 0; i < moments.size(); ++i) {
    shot.cameras.push_back(first);
    shot.cameras.back().focus += shift(i);
  }
  return shot;
}

}  // namespace elbowroom
