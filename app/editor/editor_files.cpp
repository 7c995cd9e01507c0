// SPDX-License-Identifier: MIT
// Files in and out of the editor.
#include <algorithm>
#include <cctype>
#include <utility>

#include "app/demo_document.h"
#include "app/editor/editor.h"
#include "core/editing/deliver_clip.h"
#include "core/editing/motion.h"
#include "core/io/gltf_reader.h"
#include "core/io/project_file.h"

namespace elbowroom {
namespace {

constexpr std::size_t kMostRecent = 12;

bool has_extension(const std::filesystem::path& path, const char* extension) {
  std::string own = path.extension().string();
  std::transform(own.begin(), own.end(), own.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return own == extension;
}

struct Opening {
  Document document;
  std::filesystem::path project;
  bool fresh = true;               // another document, not a change of the one that is open
  std::optional<LostWork> lost{};  // unsaved work on the project
};

}  // namespace

void Editor::open(Document document, std::filesystem::path project) {
  auto read = [this, document = std::move(document), project = std::move(project)] {
    read_files(document, project, Why::fresh);
  };
  if (!session_ || !history_.dirty()) {
    read();
    return;
  }
  // What has not been saved goes with the document that is open: that is asked about first.
  pending_opening_ = std::move(read);
  view_.dialog = Dialog::discard_for_opening;
  changed_ = true;
}

void Editor::open_demo() {
  auto document = demo_document();
  if (!document) {
    tell(Notice::Kind::error, document.error());
    return;
  }
  open(std::move(*document));
}

void Editor::open_files(const std::vector<std::filesystem::path>& paths, bool as_objects) {
  if (paths.empty()) return;
  // What a file is shows when it is read: in the background, for a glTF may be large.
  begin_job(opening_, state_.opening, "Opening " + paths.front().filename().string());
  const Document current = coming_document();
  const bool has_scene = session_ != nullptr;
  as_objects = as_objects && has_scene;
  opening_.stop = files_thread_.run([this, paths, current, has_scene, as_objects, own = project_,
                                     ticket = opening_.ticket,
                                     mailbox = mailbox_](const std::stop_token& stop) {
    Opening opening;
    std::optional<Error> error;
    bool character = false;
    std::vector<std::filesystem::path> objects;
    for (const auto& path : paths) {
      if (stop.stop_requested()) break;
      if (!as_objects && has_extension(path, ".elbow")) {
        auto document = read_project(path);
        if (!document) {
          error = document.error();
          break;
        }
        // What this session keeps of the project that is open is lost to nobody.
        opening.lost = path == own ? std::nullopt : lost_beside(path, *document);
        opening.document = std::move(*document);
        opening.project = path;
        character = true;
        continue;
      }
      ReadOptions options;
      options.images = false;
      const auto model = read_gltf(path, options);
      if (!model) {
        error = model.error();
        break;
      }
      if (!as_objects && !(*model)->characters.empty() && !character) {
        opening.document.scene.character = path;
        character = true;
      } else {
        objects.push_back(path);
      }
    }
    if (!error && !character && !has_scene)
      error = Error{"there is no character in what was opened", paths.front().string(),
                    "open a glTF file with a skinned figure first, then objects to go with it"};
    if (!character && has_scene) {
      opening.document = current;
      opening.fresh = false;
    }
    for (const auto& object : objects) opening.document.scene.obstacles.push_back(object);
    mailbox->post([this, ticket, opening = std::move(opening), error] {
      if (ticket != opening_.ticket) return;
      state_.opening.active = false;
      if (error) {
        tell(Notice::Kind::error, *error);
        return;
      }
      coming_lost_ = opening.lost;
      if (opening.fresh)
        open(opening.document, opening.project);
      else
        read_files(opening.document, opening.project, Why::change);
    });
  });
}

// The document with the scene that is being read, if one is: changes that follow build on it.
Document Editor::coming_document() const {
  Document document = history_.document();
  if (state_.opening.active && coming_scene_) document.scene = *coming_scene_;
  return document;
}

void Editor::read_files(Document document, std::filesystem::path project, Why why) {
  coming_scene_ = document.scene;
  begin_job(
      opening_, state_.opening,
      "Opening " + (project.empty() ? document.scene.character : project).filename().string());
  opening_.stop =
      files_thread_.run([this, document = std::move(document), project = std::move(project), why,
                         ticket = opening_.ticket, mailbox = mailbox_](const std::stop_token&) {
        auto session = open_project_session(document);
        mailbox->post([this, ticket, project, why, scene = document.scene,
                       session = std::make_shared<Result<Session>>(std::move(session))] {
          if (ticket != opening_.ticket) return;
          state_.opening.active = false;
          // Undo and redo may have gone back again meanwhile.
          if (why == Why::follow && history_.document().scene != scene) return;
          const bool fresh = why == Why::fresh;
          if (!*session) {
            tell(Notice::Kind::error, session->error());
            if (fresh) recovering_.reset();
            // What the document says again is what is open.
            if (!fresh && session_)
              edit("Keep the scene", Phase::committed,
                   [this](Document& changed) { changed.scene = session_->document.scene; });
            return;
          }
          opened(std::move(**session), project, fresh);
        });
      });
}

void Editor::opened(Session session, std::filesystem::path project, bool fresh) {
  for (const auto& warning : session.warnings) tell(Notice::Kind::warning, {warning, "", ""});
  if (!session.clip())
    tell(Notice::Kind::warning,
         {"this file has no animation to correct", session.document.scene.character.string(),
          "open a file with a clip"});
  const Document document = session.document;
  unseen_.reset();
  take_session(std::move(session));
  if (fresh) {
    recovery_.forget();
    project_ = std::move(project);
    history_ = History(document);
    refreshed_revision_ = 0;
    view_.framed = false;
    remember(project_.empty() ? document.scene.character : project_);
  } else {
    const bool other_clip = history_.document().scene.clip != document.scene.clip;
    edit(other_clip ? "Choose clip" : "Change scene", Phase::committed, [&](Document& changed) {
      changed.scene = document.scene;
      // What was being prepared is at times of the clip before.
      if (!other_clip) return;
      changed.draft.window.reset();
      changed.draft.target.reset();
    });
  }
  state_.strip.reset();
  state_.source_strip.reset();
  state_.playing = false;
  state_.source = session_->clip();
  if (state_.source) {
    state_.begin = state_.source->begin;
    state_.end = state_.source->end;
    state_.frame_rate = std::clamp(key_rate(*state_.source), 1.0, 240.0);
  } else {
    state_.begin = state_.end = 0;
  }
  if (fresh || state_.time < state_.begin || state_.time > state_.end) state_.time = state_.begin;
  if (fresh) view_.timeline = {};
  show_anew();
  // Its limbs may have been changed while its files were read.
  scene_changed();
  if (!fresh) return;
  const auto recovering = std::exchange(recovering_, std::nullopt);
  if (recovering && recovering->document.scene == document.scene) recover(*recovering);
  auto lost = std::exchange(coming_lost_, std::nullopt);
  if (lost && lost->project == project_) offer(std::move(*lost));
}

// From now on this session is worked on; what is under way for the one before ends.
void Editor::take_session(Session session) {
  planning_.stop.request_stop();
  scanning_.stop.request_stop();
  // What they have posted already is of the scene before.
  planning_.ticket = next_ticket_++;
  scanning_.ticket = next_ticket_++;
  state_.planning.active = state_.scanning.active = false;
  // A scene of its own for each session: a job of the old one may still be running.
  scene_work_ = std::make_shared<SceneWork>();
  target_work_->abandon();
  target_work_ = std::make_shared<TargetWork>();
  session_ = std::make_shared<const Session>(std::move(session));
}

// All that follows from session and document, made anew.
void Editor::show_anew() {
  state_.candidate.reset();
  state_.failure.reset();
  state_.clip.reset();
  state_.corrections.clear();
  shown_corrections_.clear();
  shown_target_.reset();
  shown_limb_.clear();
  refresh();
  refreshed_revision_ = history_.revision();
  prepare_contacts();
  changed_ = true;
}

// Undo and redo go through changes of the scene and of its limbs too.
void Editor::scene_changed() {
  if (!session_) return;
  if (history_.document().scene != session_->document.scene)
    read_files(history_.document(), project_, Why::follow);
  else if (history_.document().limbs != session_->document.limbs ||
           history_.document().swing_limits != session_->document.swing_limits)
    refit();
}

void Editor::attach_object(const std::filesystem::path& file, const std::string& joint) {
  if (!session_) return;
  Document changed = coming_document();
  auto& scene = changed.scene;
  const auto held = std::find_if(scene.attachments.begin(), scene.attachments.end(),
                                 [&](const AttachedFile& a) { return a.file == file; });
  const bool was_held = held != scene.attachments.end();
  if (was_held) scene.attachments.erase(held);
  std::erase(scene.obstacles, file);
  if (joint.empty())
    scene.obstacles.push_back(file);
  else
    scene.attachments.push_back({file, joint, {}});
  if (changed.scene == history_.document().scene) return;
  read_files(std::move(changed), project_, Why::change);
}

void Editor::remove_object(const std::filesystem::path& file) {
  if (!session_) return;
  Document changed = coming_document();
  std::erase(changed.scene.obstacles, file);
  std::erase_if(changed.scene.attachments, [&](const AttachedFile& a) { return a.file == file; });
  if (changed.scene == history_.document().scene) return;
  read_files(std::move(changed), project_, Why::change);
}

void Editor::choose_clip(const std::string& name) {
  if (!session_ || history_.document().scene.clip == name) return;
  Document changed = history_.document();
  changed.scene.clip = name;
  read_files(std::move(changed), project_, Why::change);
}

void Editor::remember(const std::filesystem::path& path) {
  if (path.empty()) return;
  std::error_code error;
  const std::string text = std::filesystem::absolute(path, error).string();
  std::erase(state_.recent_files, text);
  state_.recent_files.insert(state_.recent_files.begin(), text);
  if (state_.recent_files.size() > kMostRecent) state_.recent_files.resize(kMostRecent);
}

void Editor::save(const std::filesystem::path& path) {
  if (!session_) return;
  history_.commit();
  document_changed();
  const auto target = path.empty() ? project_ : path;
  if (target.empty()) {
    view_.dialog = Dialog::save_project;
    return;
  }
  if (Status saved = write_project(target, history_.document(), project_); !saved) {
    tell(Notice::Kind::error, saved.error());
    return;
  }
  project_ = target;
  history_.mark_saved();
  remember(target);
  refresh();
  tell(Notice::Kind::good, {"Saved", target.filename().string(), ""});
}

void Editor::export_to(const std::filesystem::path& path) {
  if (!session_ || !state_.clip || path.empty()) return;
  const SceneDescription& scene = history_.document().scene;
  std::vector<std::filesystem::path> in_use = {scene.character, project_};
  in_use.insert(in_use.end(), scene.obstacles.begin(), scene.obstacles.end());
  for (const AttachedFile& held : scene.attachments) in_use.push_back(held.file);
  for (const auto& file : in_use) {
    std::error_code error;
    if (file.empty() || !std::filesystem::equivalent(path, file, error)) continue;
    tell(Notice::Kind::error,
         {"that would write over a file of the scene", path.string(), "export under another name"});
    return;
  }
  for (std::size_t i = 0; i < state_.corrections.size(); ++i)
    if (!state_.corrections[i].fits) {
      tell(Notice::Kind::error, {"the correction \"" + history_.document().corrections[i].name +
                                     "\" no longer fits the motion below it",
                                 "", "replan, mute or delete it, then export again"});
      return;
    }
  // The source is never changed: it is what corrections lie over when the project is opened again.
  std::error_code ignored;
  if (std::filesystem::equivalent(path, history_.document().scene.character, ignored)) {
    tell(Notice::Kind::error, {"the character's own file is not written over", path.string(),
                               "export under another name"});
    return;
  }
  begin_job(exporting_, state_.exporting, "Exporting " + path.filename().string());
  exporting_.stop = files_thread_.run([this, path, source = history_.document().scene.character,
                                       clip = state_.clip, ticket = exporting_.ticket,
                                       mailbox = mailbox_](const std::stop_token&) {
    const auto exported = deliver_clip(source, *clip, path);
    mailbox->post([this, ticket, path, exported] {
      if (ticket != exporting_.ticket) return;
      state_.exporting.active = false;
      if (!exported) {
        tell(Notice::Kind::error, exported.error());
        return;
      }
      for (const auto& warning : exported->warnings) tell(Notice::Kind::warning, {warning, "", ""});
      tell(Notice::Kind::good,
           {exported->animations.empty()
                ? "Exported a copy: there is nothing corrected"
                : "Exported with the animation \"" + exported->animations.front().name + "\"",
            path.filename().string(), ""});
    });
  });
}

}  // namespace elbowroom
