// SPDX-License-Identifier: MIT
#include "assets/generator/glb.h"

#include <algorithm>
#include <cstring>
#include <nlohmann/json.hpp>

namespace elbowroom::demo {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963;
constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kUnsignedInt = 5125, kFloat = 5126;

class Writer {
 public:
  explicit Writer(const GlbFile& file) : file_(file) {}

  std::string run() {
    json_["asset"] = {{"version", "2.0"}, {"generator", file_.generator_note}};
    json_["scene"] = 0;
    Json roots = Json::array();
    for (std::size_t i = 0; i < file_.nodes.size(); ++i)
      if (file_.nodes[i].parent < 0) roots.push_back(i);
    json_["scenes"] = Json::array({{{"nodes", roots}}});
    nodes();
    materials();
    meshes();
    skins();
    clips();
    while (bin_.size() % 4 != 0) bin_.push_back('\0');
    json_["accessors"] = accessors_;
    json_["bufferViews"] = views_;
    json_["buffers"] = Json::array({{{"byteLength", bin_.size()}}});

    std::string text = json_.dump();
    while (text.size() % 4 != 0) text.push_back(' ');
    std::string out;
    const auto word = [&](std::uint32_t w) {
      for (int i = 0; i < 4; ++i) out.push_back(static_cast<char>(w >> (8 * i)));
    };
    word(0x46546C67);
    word(2);
    word(static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + bin_.size()));
    word(static_cast<std::uint32_t>(text.size()));
    word(0x4E4F534A);
    out += text;
    word(static_cast<std::uint32_t>(bin_.size()));
    word(0x004E4942);
    out += bin_;
    return out;
  }

 private:
  void nodes() {
    Json nodes = Json::array();
    for (std::size_t i = 0; i < file_.nodes.size(); ++i) {
      const GlbNode& n = file_.nodes[i];
      Json node = {{"name", n.name}};
      Json children = Json::array();
      for (std::size_t k = 0; k < file_.nodes.size(); ++k)
        if (file_.nodes[k].parent == static_cast<int>(i)) children.push_back(k);
      if (!children.empty()) node["children"] = children;
      if (n.translation != Vec3(0.0))
        node["translation"] = {number(n.translation.x), number(n.translation.y),
                               number(n.translation.z)};
      if (n.rotation != Quat(1, 0, 0, 0)) {
        const auto q = unit_floats(n.rotation);
        node["rotation"] = {q[0], q[1], q[2], q[3]};
      }
      if (n.mesh >= 0) node["mesh"] = n.mesh;
      if (n.skinned) node["skin"] = 0;
      nodes.push_back(node);
    }
    json_["nodes"] = nodes;
  }

  void materials() {
    Json materials = Json::array();
    for (const GlbMaterial& m : file_.materials) {
      Json material = {{"name", m.name},
                       {"pbrMetallicRoughness",
                        {{"baseColorFactor", {m.color[0], m.color[1], m.color[2], 1.0f}},
                         {"metallicFactor", m.metallic},
                         {"roughnessFactor", m.roughness}}}};
      if (m.double_sided) material["doubleSided"] = true;
      materials.push_back(material);
    }
    json_["materials"] = materials;
  }

  void meshes() {
    Json meshes = Json::array();
    for (const GlbMesh& m : file_.meshes) {
      Json primitives = Json::array();
      for (const GlbPrimitive& p : m.primitives) {
        Json attributes;
        attributes["POSITION"] = vectors(p.positions, kArrayBuffer, true);
        attributes["NORMAL"] = vectors(p.normals, kArrayBuffer, false);
        if (!p.weights.empty()) {
          const std::size_t joints_at = begin_view(kArrayBuffer);
          for (const VertexWeights& w : p.weights)
            for (const std::uint8_t j : w.joint) bin_.push_back(static_cast<char>(j));
          attributes["JOINTS_0"] = accessor(joints_at, kUnsignedByte, p.weights.size(), "VEC4");
          const std::size_t weights_at = begin_view(kArrayBuffer);
          for (const VertexWeights& w : p.weights)
            for (const float f : w.weight) put(f);
          attributes["WEIGHTS_0"] = accessor(weights_at, kFloat, p.weights.size(), "VEC4");
        }
        const bool wide = p.positions.size() > 65535;
        const std::size_t at = begin_view(kElementArrayBuffer);
        for (const auto& t : p.triangles)
          for (const std::uint32_t i : t) wide ? put(i) : put(static_cast<std::uint16_t>(i));
        primitives.push_back({{"attributes", attributes},
                              {"indices", accessor(at, wide ? kUnsignedInt : kUnsignedShort,
                                                   3 * p.triangles.size(), "SCALAR")},
                              {"material", p.material}});
      }
      meshes.push_back({{"name", m.name}, {"primitives", primitives}});
    }
    json_["meshes"] = meshes;
  }

  void skins() {
    if (file_.skins.empty()) return;
    Json skins = Json::array();
    for (const GlbSkin& s : file_.skins) {
      const std::size_t at = begin_view(0);
      for (const Mat4& m : s.inverse_bind)
        for (int c = 0; c < 4; ++c)
          for (int r = 0; r < 4; ++r) put(static_cast<float>(m[c][r]));
      const std::size_t matrices = accessor(at, kFloat, s.inverse_bind.size(), "MAT4");
      skins.push_back({{"name", s.name},
                       {"inverseBindMatrices", matrices},
                       {"skeleton", s.joints.front()},
                       {"joints", s.joints}});
    }
    json_["skins"] = skins;
  }

  void clips() {
    if (file_.clips.empty()) return;
    Json animations = Json::array();
    for (const GlbClip& clip : file_.clips) {
      const std::size_t at = begin_view(0);
      for (const double t : clip.times) put(static_cast<float>(t));
      const std::size_t input = accessor(at, kFloat, clip.times.size(), "SCALAR");
      accessors_[input]["min"] = {static_cast<float>(clip.times.front())};
      accessors_[input]["max"] = {static_cast<float>(clip.times.back())};
      Json channels = Json::array(), samplers = Json::array();
      for (const GlbChannel& c : clip.channels) {
        std::size_t output;
        if (c.rotation) {
          const std::size_t begin = begin_view(0);
          Quat last(1, 0, 0, 0);
          for (Quat q : c.quats) {
            if (glm::dot(q, last) < 0) q = -q;
            last = q;
            for (const float f : unit_floats(q)) put(f);
          }
          output = accessor(begin, kFloat, c.quats.size(), "VEC4");
        } else {
          output = vectors(c.vectors, 0, false);
        }
        channels.push_back(
            {{"sampler", samplers.size()},
             {"target", {{"node", c.node}, {"path", c.rotation ? "rotation" : "translation"}}}});
        samplers.push_back({{"input", input}, {"interpolation", "LINEAR"}, {"output", output}});
      }
      animations.push_back({{"name", clip.name}, {"channels", channels}, {"samplers", samplers}});
    }
    json_["animations"] = animations;
  }

  // Numbers of the JSON part are float32 too: shorter, and what a reader makes of them anyway. The
  // sum with 0 turns -0 to 0.
  static float number(double v) { return static_cast<float>(v) + 0.0f; }

  static std::array<float, 4> unit_floats(const Quat& q) {
    const Quat u = glm::normalize(q);
    return {number(u.x), number(u.y), number(u.z), number(u.w)};
  }

  template <typename T>
  void put(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));  // glTF and the machines we build on are little-endian
    bin_.append(bytes, sizeof(T));
  }

  std::size_t begin_view(int target) {
    while (bin_.size() % 4 != 0) bin_.push_back('\0');
    view_target_ = target;
    return bin_.size();
  }

  std::size_t accessor(std::size_t begin, int type, std::size_t count, const char* shape) {
    Json view = {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", bin_.size() - begin}};
    if (view_target_ != 0) view["target"] = view_target_;
    views_.push_back(view);
    accessors_.push_back({{"bufferView", views_.size() - 1},
                          {"componentType", type},
                          {"count", count},
                          {"type", shape}});
    return accessors_.size() - 1;
  }

  std::size_t vectors(const std::vector<Vec3>& v, int target, bool range) {
    const std::size_t begin = begin_view(target);
    glm::vec3 low(1e30f), high(-1e30f);
    for (const Vec3& p : v) {
      const glm::vec3 f(number(p.x), number(p.y), number(p.z));
      low = glm::min(low, f);
      high = glm::max(high, f);
      for (int i = 0; i < 3; ++i) put(f[i]);
    }
    const std::size_t a = accessor(begin, kFloat, v.size(), "VEC3");
    if (range) {
      accessors_[a]["min"] = {low.x, low.y, low.z};
      accessors_[a]["max"] = {high.x, high.y, high.z};
    }
    return a;
  }

  const GlbFile& file_;
  Json json_, accessors_ = Json::array(), views_ = Json::array();
  std::string bin_;
  int view_target_ = 0;
};

}  // namespace

std::string to_glb(const GlbFile& file) { return Writer(file).run(); }

}  // namespace elbowroom::demo
