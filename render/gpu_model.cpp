// SPDX-License-Identifier: MIT
#include "render/gpu_model.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

namespace elbowroom {
namespace {

template <typename T>
GlBuffer upload(const std::vector<T>& items) {
  return make_static_buffer(items.data(), items.size() * sizeof(T));
}

GlTexture upload_image(const Image& image) {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  const auto pixels = static_cast<std::size_t>(std::max(image.width, 0)) *
                      static_cast<std::size_t>(std::max(image.height, 0));
  if (pixels == 0 || image.rgba.size() < 4 * pixels || image.width > largest ||
      image.height > largest) {
    return GlTexture();
  }
  const int levels = std::bit_width(static_cast<unsigned>(std::max(image.width, image.height)));
  GlTexture texture = make_texture(GL_SRGB8_ALPHA8, image.width, image.height, levels);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTextureSubImage2D(texture.name(), 0, 0, 0, image.width, image.height, GL_RGBA, GL_UNSIGNED_BYTE,
                      image.rgba.data());
  glGenerateTextureMipmap(texture.name());
  glTextureParameteri(texture.name(), GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTextureParameteri(texture.name(), GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  return texture;
}

// Layouts as shaders/skin.comp.glsl has them.
struct ActiveMorph {
  std::uint32_t block;
  float weight;
};
struct MeshMorphs {
  std::uint32_t begin, end;
};

bool same(const std::vector<PaletteEntry>& a, const std::vector<PaletteEntry>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(PaletteEntry)) == 0);
}

Bounds box_of(const RenderGeometry& geometry, const RenderMesh& mesh,
              const std::vector<PaletteEntry>& palette, const Vec3& origin) {
  Bounds bounds;
  for (auto entry = mesh.palette_begin; entry < mesh.palette_end; ++entry) {
    const auto& box = geometry.palette_boxes[entry];
    if (box.lower.x > box.upper.x) continue;
    for (int i = 0; i < 8; ++i) {
      const glm::vec4 corner((i & 1) ? box.upper.x : box.lower.x,
                             (i & 2) ? box.upper.y : box.lower.y,
                             (i & 4) ? box.upper.z : box.lower.z, 1.0f);
      bounds.add(origin + Vec3(glm::dot(palette[entry].row[0], corner),
                               glm::dot(palette[entry].row[1], corner),
                               glm::dot(palette[entry].row[2], corner)));
    }
  }
  return bounds;
}

}  // namespace

GpuModel::GpuModel(std::shared_ptr<const Model> model)
    : model_(std::move(model)), geometry_(make_render_geometry(*model_)) {
  static_assert(sizeof(RenderVertex) == 32 && sizeof(RenderBinding) == 16);
  vertices_ = upload(geometry_.vertices);
  bindings_ = upload(geometry_.bindings);
  influences_ = upload(geometry_.influences);
  morph_offsets_ = upload(geometry_.morph_offsets);
  indices_ = upload(geometry_.indices);
  for (const auto& image : model_->images) images_.push_back(upload_image(image));
  white_ = make_texture(GL_RGBA8, 1, 1);
  const unsigned char pixel[4] = {255, 255, 255, 255};
  glTextureSubImage2D(white_.name(), 0, 0, 0, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel);
}

unsigned GpuModel::texture(int material) const {
  if (material < 0 || material >= static_cast<int>(model_->materials.size())) return white_.name();
  const int image = model_->materials[static_cast<std::size_t>(material)].base_color_image;
  if (image < 0 || image >= static_cast<int>(images_.size())) return white_.name();
  const auto& texture = images_[static_cast<std::size_t>(image)];
  return texture ? texture.name() : white_.name();
}

GpuFigure::GpuFigure() : array_(make_vertex_array()) {
  const GLuint array = array_.name();
  const auto attribute = [array](GLuint index, GLuint binding, GLint size, GLuint offset) {
    glEnableVertexArrayAttrib(array, index);
    glVertexArrayAttribFormat(array, index, size, GL_FLOAT, GL_FALSE, offset);
    glVertexArrayAttribBinding(array, index, binding);
  };
  attribute(0, 0, 4, 0);   // position, emphasis
  attribute(1, 0, 3, 16);  // normal
  attribute(2, 1, 1, 12);  // u
  attribute(3, 1, 1, 28);  // v
}

void GpuFigure::deform(const GlProgram& skinning, const GpuModel& model, const ActorState& state,
                       const Vec3& origin, const std::vector<float>& emphasis) {
  const RenderGeometry& geometry = model.geometry();
  winding_ = make_palette(model.model(), geometry, state.world_from_joint, origin, emphasis,
                          palette_entries_);
  bounds_.clear();
  for (const auto& mesh : geometry.meshes) {
    bounds_.push_back(box_of(geometry, mesh, palette_entries_, origin));
  }

  std::vector<ActiveMorph> active;
  std::vector<MeshMorphs> ranges;
  for (std::size_t m = 0; m < geometry.meshes.size(); ++m) {
    const Mesh& mesh = model.model().meshes[m];
    const auto begin = static_cast<std::uint32_t>(active.size());
    const auto node = static_cast<std::size_t>(std::max(mesh.node, 0));
    const auto& posed = state.pose.morph_weights;
    const bool has_own = node >= posed.size() || posed[node].empty();
    const auto& weights = has_own ? mesh.morph_weights : posed[node];
    const auto& blocks = geometry.meshes[m].morph_block;
    for (std::size_t k = 0; k < std::min(weights.size(), blocks.size()); ++k) {
      if (blocks[k] < 0 || weights[k] == 0 || !std::isfinite(weights[k])) continue;
      active.push_back({static_cast<std::uint32_t>(blocks[k]), static_cast<float>(weights[k])});
    }
    ranges.push_back({begin, static_cast<std::uint32_t>(active.size())});
  }
  morphs_.clear();
  for (const auto& range : ranges) morphs_.insert(morphs_.end(), {range.begin, range.end});
  for (const auto& morph : active) {
    morphs_.insert(morphs_.end(), {morph.block, std::bit_cast<std::uint32_t>(morph.weight)});
  }
  const auto identity = model.identity();
  const bool same_model = !model_.owner_before(identity) && !identity.owner_before(model_);
  const bool unchanged = version_ > 0 && same_model && origin_ == origin &&
                         morphs_ == last_morphs_ && same(palette_entries_, last_palette_);
  if (unchanged) return;
  ++version_;
  model_ = identity;
  origin_ = origin;
  last_morphs_ = morphs_;
  last_palette_ = palette_entries_;
  palette_.write(palette_entries_.data(), palette_entries_.size() * sizeof(PaletteEntry));
  active_morphs_.write(active.data(), active.size() * sizeof(ActiveMorph));
  mesh_morphs_.write(ranges.data(), ranges.size() * sizeof(MeshMorphs));
  const auto count = static_cast<GLuint>(geometry.vertices.size());
  deformed_.reserve(std::size_t{count} * 32);

  const GLuint buffers[] = {model.vertices(),      model.bindings(),    model.influences(),
                            palette_.name(),       mesh_morphs_.name(), active_morphs_.name(),
                            model.morph_offsets(), deformed_.name()};
  for (GLuint i = 0; i < std::size(buffers); ++i) {
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, i, buffers[i]);
  }
  glUseProgram(skinning.name());
  glUniform1ui(0, count);
  // Groups in a square, as one dimension may be limited to 65,535 of them.
  const GLuint groups = (count + 63) / 64;
  const GLuint wide = std::min<GLuint>(groups, 1024);
  if (groups > 0) glDispatchCompute(wide, (groups + wide - 1) / wide, 1);
  glMemoryBarrier(GL_VERTEX_ATTRIB_ARRAY_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);

  glVertexArrayVertexBuffer(array_.name(), 0, deformed_.name(), 0, 32);
  glVertexArrayVertexBuffer(array_.name(), 1, model.vertices(), 0, 32);
  glVertexArrayElementBuffer(array_.name(), model.indices());
}

void GpuFigure::bind() const { glBindVertexArray(array_.name()); }

void GpuFigure::draw(const GpuModel& model, int mesh) const {
  const auto& range = model.geometry().meshes[static_cast<std::size_t>(mesh)];
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(range.index_count), GL_UNSIGNED_INT,
                 reinterpret_cast<const void*>(std::uintptr_t{range.first_index} * 4));
}

std::vector<Vec3> GpuFigure::read_positions(const GpuModel& model) const {
  const std::size_t count = model.geometry().vertices.size();
  std::vector<glm::vec4> raw(2 * count);
  if (count > 0) {
    glGetNamedBufferSubData(deformed_.name(), 0, static_cast<GLsizeiptr>(count * 32), raw.data());
  }
  std::vector<Vec3> positions(count);
  for (std::size_t i = 0; i < count; ++i) positions[i] = origin_ + Vec3(glm::vec3(raw[2 * i]));
  return positions;
}

}  // namespace elbowroom
