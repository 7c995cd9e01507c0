// SPDX-License-Identifier: MIT
// The dialogs that lie over the window: files in and out, the sheet of shortcuts, the limbs'
// joints, unsaved work.
#pragma once

#include "ui/panels/limb_joints.h"
#include "ui/panels/panel.h"
#include "ui/toolkit/file_dialog.h"

namespace elbowroom {

class Dialogs {
 public:
  // In every frame, after the panels.
  void draw(const PanelContext& context);

 private:
  void open_files(const PanelContext& context);
  void files(const PanelContext& context);
  void shortcuts(const PanelContext& context);
  void unsaved(const PanelContext& context);
  void recover(const PanelContext& context);

  FileDialog file_dialog_;
  LimbJointsDialog limb_joints_;
  Dialog shown_ = Dialog::none;
  Dialog after_saving_ = Dialog::none;  // what the save dialog was opened for
};

}  // namespace elbowroom
