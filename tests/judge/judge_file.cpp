// SPDX-License-Identifier: MIT
#include "tests/judge/judge_file.h"

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <glm/gtc/type_ptr.hpp>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace judge {
namespace {

using nlohmann::json;

[[noreturn]] void fail(const std::string& what) { throw std::runtime_error("judge: " + what); }

std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) fail("cannot open " + path.string());
  return std::string(std::istreambuf_iterator<char>(in), {});
}

std::string unescape_uri(const std::string& uri) {
  std::string text;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    if (uri[i] == '%' && i + 2 < uri.size()) {
      text += static_cast<char>(std::stoi(uri.substr(i + 1, 2), nullptr, 16));
      i += 2;
    } else {
      text += uri[i];
    }
  }
  return text;
}

std::string base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned held = 0;
  int bits = 0;
  for (const char c : text) {
    const auto digit = digits.find(c);
    if (digit == std::string::npos) break;
    held = held * 64 + static_cast<unsigned>(digit);
    bits += 6;
    if (bits >= 8) {
      bits -= 8;
      bytes += static_cast<char>(held >> bits);
      held &= (1u << bits) - 1;
    }
  }
  return bytes;
}

struct Elements {
  int components = 0;
  std::size_t count = 0;
  std::vector<double> values;
  std::vector<std::uint8_t> raw;
};

class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) {
    file_.path = path;
    const std::string bytes = slurp(path);
    if (bytes.compare(0, 4, "glTF") == 0) {
      file_.binary = true;
      std::size_t at = 12;
      while (at + 8 <= bytes.size()) {
        std::uint32_t head[2];
        std::memcpy(head, bytes.data() + at, 8);
        if (head[1] == 0x4E4F534A) file_.json = bytes.substr(at + 8, head[0]);
        if (head[1] == 0x004E4942) file_.bin = bytes.substr(at + 8, head[0]);
        at += 8 + std::size_t{head[0]};
      }
    } else {
      file_.json = bytes;
    }
    doc_ = json::parse(file_.json);
    for (const json& extension : list("extensionsRequired")) {
      const std::string text = extension;
      if (text.find("draco") != std::string::npos || text.find("meshopt") != std::string::npos) {
        fail(text + " is not read");
      }
    }
    std::size_t index = 0;
    for (const json& buffer : list("buffers")) {
      const std::string uri = buffer.value("uri", "");
      if (uri.empty()) {
        buffers_.push_back(index == 0 ? file_.bin : std::string());
      } else if (uri.compare(0, 5, "data:") == 0) {
        buffers_.push_back(base64(uri.substr(uri.find(',') + 1)));
      } else {
        buffers_.push_back(slurp(path.parent_path() / unescape_uri(uri)));
      }
      ++index;
    }
    read_nodes();
    read_meshes();
    read_skins();
    read_animations();
  }
  File take() {
    file_.buffers = std::move(buffers_);
    return std::move(file_);
  }

 private:
  const json& list(const char* key) const {
    static const json none = json::array();
    const auto found = doc_.find(key);
    return found == doc_.end() ? none : *found;
  }

  const char* bytes_of(const json& view_index, std::size_t offset, std::size_t length) const {
    const json& view = list("bufferViews").at(view_index.get<std::size_t>());
    const std::string& buffer = buffers_.at(view.at("buffer").get<std::size_t>());
    const std::size_t begin = view.value("byteOffset", std::size_t{0}) + offset;
    if (begin + length > buffer.size()) fail("an accessor leaves its buffer");
    return buffer.data() + begin;
  }

  static std::size_t size_of(int type) {
    return type == 5120 || type == 5121 ? 1 : type == 5122 || type == 5123 ? 2 : 4;
  }

  static double component(const char* at, int type, bool normalized) {
    const auto as = [at](auto value) {
      std::memcpy(&value, at, sizeof value);
      return static_cast<double>(value);
    };
    switch (type) {
      case 5120: {
        const double v = as(std::int8_t{});
        return normalized ? std::fmax(v / 127.0, -1.0) : v;
      }
      case 5121:
        return as(std::uint8_t{}) / (normalized ? 255.0 : 1.0);
      case 5122: {
        const double v = as(std::int16_t{});
        return normalized ? std::fmax(v / 32767.0, -1.0) : v;
      }
      case 5123:
        return as(std::uint16_t{}) / (normalized ? 65535.0 : 1.0);
      case 5125:
        return as(std::uint32_t{});
      case 5126:
        return as(float{});
      default:
        fail("unknown component type");
    }
  }

  Elements accessor(std::size_t index) const {
    const json& a = list("accessors").at(index);
    const std::string type = a.at("type");
    Elements e;
    e.components = type == "SCALAR" ? 1
                   : type == "VEC2" ? 2
                   : type == "VEC3" ? 3
                   : type == "MAT4" ? 16
                                    : 4;
    e.count = a.at("count");
    const int component_type = a.at("componentType");
    const bool normalized = a.value("normalized", false);
    const std::size_t element = size_of(component_type) * static_cast<std::size_t>(e.components);
    e.raw.assign(e.count * element, 0);
    if (a.contains("bufferView") && e.count > 0) {
      const json& view = list("bufferViews").at(a["bufferView"].get<std::size_t>());
      const std::size_t stride = view.value("byteStride", element);
      const char* from = bytes_of(a["bufferView"], a.value("byteOffset", std::size_t{0}),
                                  stride * (e.count - 1) + element);
      for (std::size_t i = 0; i < e.count; ++i) {
        std::memcpy(e.raw.data() + i * element, from + i * stride, element);
      }
    }
    if (a.contains("sparse")) {
      const json &sparse = a["sparse"], &indices = sparse.at("indices"),
                 &values = sparse.at("values");
      const std::size_t count = sparse.at("count");
      const int index_type = indices.at("componentType");
      const char* at =
          bytes_of(indices.at("bufferView"), indices.value("byteOffset", std::size_t{0}),
                   count * size_of(index_type));
      const char* from = bytes_of(values.at("bufferView"),
                                  values.value("byteOffset", std::size_t{0}), count * element);
      for (std::size_t i = 0; i < count; ++i) {
        const auto to =
            static_cast<std::size_t>(component(at + i * size_of(index_type), index_type, false));
        if (to >= e.count) fail("a sparse index leaves its accessor");
        std::memcpy(e.raw.data() + to * element, from + i * element, element);
      }
    }
    e.values.resize(e.count * static_cast<std::size_t>(e.components));
    for (std::size_t i = 0; i < e.values.size(); ++i) {
      e.values[i] =
          component(reinterpret_cast<const char*>(e.raw.data()) + i * size_of(component_type),
                    component_type, normalized);
    }
    return e;
  }

  std::vector<glm::dvec3> vectors(std::size_t index) const {
    const Elements e = accessor(index);
    std::vector<glm::dvec3> all(e.count);
    for (std::size_t i = 0; i < e.count; ++i) all[i] = glm::make_vec3(e.values.data() + 3 * i);
    return all;
  }

  void read_nodes() {
    for (const json& n : list("nodes")) {
      Node node;
      node.name = n.value("name", "");
      const auto numbers = [&](const char* key) { return n.at(key).get<std::vector<double>>(); };
      if (n.contains("matrix")) node.matrix = glm::make_mat4(numbers("matrix").data());
      if (n.contains("translation"))
        node.translation = glm::make_vec3(numbers("translation").data());
      if (n.contains("scale")) node.scale = glm::make_vec3(numbers("scale").data());
      if (n.contains("rotation")) {
        const auto q = numbers("rotation");
        node.rotation = glm::normalize(glm::dquat(q[3], q[0], q[1], q[2]));
      }
      node.mesh = n.value("mesh", -1);
      node.skin = n.value("skin", -1);
      if (n.contains("weights")) node.weights = numbers("weights");
      file_.nodes.push_back(std::move(node));
    }
    for (std::size_t i = 0; i < file_.nodes.size(); ++i) {
      for (const json& child : list("nodes")[i].value("children", json::array())) {
        file_.nodes.at(child.get<std::size_t>()).parent = static_cast<int>(i);
      }
    }
    std::function<void(int)> visit = [&](int node) {
      file_.order.push_back(node);
      if (file_.order.size() > file_.nodes.size()) fail("nodes loop");
      const json& n = list("nodes")[static_cast<std::size_t>(node)];
      for (const json& child : n.value("children", json::array())) visit(child.get<int>());
    };
    for (std::size_t i = 0; i < file_.nodes.size(); ++i) {
      if (file_.nodes[i].parent < 0) visit(static_cast<int>(i));
    }
    std::vector<int> roots;
    if (list("scenes").empty()) {
      for (const int i : file_.order) {
        if (file_.nodes[static_cast<std::size_t>(i)].parent < 0) roots.push_back(i);
      }
    } else {
      const json& scene = list("scenes").at(doc_.value("scene", std::size_t{0}));
      roots = scene.value("nodes", std::vector<int>());
    }
    for (const int i : roots) file_.nodes.at(static_cast<std::size_t>(i)).in_scene = true;
    for (const int i : file_.order) {
      Node& node = file_.nodes[static_cast<std::size_t>(i)];
      if (node.parent >= 0 && file_.nodes[static_cast<std::size_t>(node.parent)].in_scene) {
        node.in_scene = true;
      }
    }
  }

  void read_meshes() {
    for (const json& m : list("meshes")) {
      MeshData mesh;
      mesh.weights = m.value("weights", std::vector<double>());
      for (const json& p : m.at("primitives")) {
        const int mode = p.value("mode", 4);
        const json& attributes = p.at("attributes");
        if (mode < 4 || mode > 6 || !attributes.contains("POSITION")) continue;
        Primitive primitive;
        primitive.positions = vectors(attributes["POSITION"]);
        std::vector<unsigned> indices;
        if (p.contains("indices")) {
          for (const double i : accessor(p["indices"]).values)
            indices.push_back(static_cast<unsigned>(i));
        } else {
          for (unsigned i = 0; i < primitive.positions.size(); ++i) indices.push_back(i);
        }
        for (const unsigned i : indices) {
          if (i >= primitive.positions.size()) fail("an index leaves its mesh");
        }
        if (mode == 4) {
          for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
            primitive.triangles.emplace_back(indices[i], indices[i + 1], indices[i + 2]);
          }
        } else {
          for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
            const bool odd = mode == 5 && i % 2 == 1;
            primitive.triangles.emplace_back(mode == 6 ? indices[0] : indices[i],
                                             indices[i + (odd ? 2 : 1)],
                                             indices[i + (odd ? 1 : 2)]);
          }
        }
        primitive.influences.resize(primitive.positions.size());
        for (int set = 0;; ++set) {
          const std::string tail = "_" + std::to_string(set);
          if (!attributes.contains("JOINTS" + tail) || !attributes.contains("WEIGHTS" + tail))
            break;
          const Elements joints = accessor(attributes["JOINTS" + tail]);
          const Elements weights = accessor(attributes["WEIGHTS" + tail]);
          for (std::size_t v = 0; v < primitive.positions.size(); ++v) {
            for (std::size_t k = 0; k < 4; ++k) {
              const double weight = weights.values.at(4 * v + k);
              if (weight > 0) {
                primitive.influences[v].emplace_back(static_cast<int>(joints.values.at(4 * v + k)),
                                                     weight);
              } else if (set == 0 && k == 0) {
                primitive.influences[v].emplace_back(static_cast<int>(joints.values.at(4 * v)),
                                                     0.0);
              }
            }
          }
        }
        for (auto& all : primitive.influences) {
          double sum = 0;
          for (const auto& [slot, weight] : all) sum += weight;
          for (auto& [slot, weight] : all) weight = sum > 0 ? weight / sum : 1;
        }
        for (const json& target : p.value("targets", json::array())) {
          primitive.morphs.push_back(target.contains("POSITION") ? vectors(target["POSITION"])
                                                                 : std::vector<glm::dvec3>());
        }
        mesh.primitives.push_back(std::move(primitive));
      }
      file_.meshes.push_back(std::move(mesh));
    }
  }

  void read_skins() {
    for (const json& s : list("skins")) {
      SkinData skin;
      skin.joints = s.at("joints").get<std::vector<int>>();
      skin.inverse_bind.assign(skin.joints.size(), glm::dmat4(1.0));
      if (s.contains("inverseBindMatrices")) {
        const Elements e = accessor(s["inverseBindMatrices"]);
        for (std::size_t i = 0; i < skin.joints.size(); ++i) {
          skin.inverse_bind[i] = glm::make_mat4(e.values.data() + 16 * i);
        }
      }
      file_.skins.push_back(std::move(skin));
    }
  }

  void read_animations() {
    for (const json& a : list("animations")) {
      KeyAnimation animation;
      animation.name = a.value("name", "");
      bool first = true;
      for (const json& c : a.at("channels")) {
        const json& target = c.at("target");
        if (!target.contains("node")) continue;
        const json& sampler = a.at("samplers").at(c.at("sampler").get<std::size_t>());
        KeyChannel channel;
        channel.node = target["node"];
        channel.path = target.at("path");
        channel.interpolation = sampler.value("interpolation", "LINEAR");
        Elements input = accessor(sampler.at("input")), output = accessor(sampler.at("output"));
        for (const double t : input.values) channel.times.push_back(static_cast<float>(t));
        const std::size_t keys =
            channel.times.size() * (channel.interpolation == "CUBICSPLINE" ? 3 : 1);
        // What has no value for each key cannot be played; its bytes still count.
        const bool playable =
            keys > 0 && !output.values.empty() && output.values.size() % keys == 0;
        if (playable) channel.components = static_cast<int>(output.values.size() / keys);
        channel.values = std::move(output.values);
        channel.raw_times = std::move(input.raw);
        channel.raw_values = std::move(output.raw);
        if (!playable) {
          animation.channels.push_back(std::move(channel));
          continue;
        }
        const double begin = channel.times.front(), end = channel.times.back();
        animation.begin = first ? begin : std::fmin(animation.begin, begin);
        animation.end = first ? end : std::fmax(animation.end, end);
        first = false;
        animation.channels.push_back(std::move(channel));
      }
      file_.animations.push_back(std::move(animation));
    }
  }

  File file_;
  json doc_;
  std::vector<std::string> buffers_;
};

}  // namespace

const KeyAnimation& File::animation(const std::string& name_or_index) const {
  for (const KeyAnimation& animation : animations) {
    if (animation.name == name_or_index) return animation;
  }
  const bool number =
      !name_or_index.empty() && name_or_index.find_first_not_of("0123456789") == std::string::npos;
  if (!number || std::stoul(name_or_index) >= animations.size()) {
    fail("no animation " + name_or_index + " in " + path.string());
  }
  return animations[std::stoul(name_or_index)];
}

int File::node(const std::string& name) const {
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].name == name) return static_cast<int>(i);
  }
  fail("no node " + name + " in " + path.string());
}

bool File::is_within(int node, int ancestor) const {
  for (; node >= 0; node = nodes[static_cast<std::size_t>(node)].parent) {
    if (node == ancestor) return true;
  }
  return false;
}

File load(const std::filesystem::path& path) { return Reader(path).take(); }

}  // namespace judge
