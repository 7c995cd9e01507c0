// SPDX-License-Identifier: MIT
// All of the toolkit, for panels.
#pragma once

#include "ui/toolkit/buttons.h"
#include "ui/toolkit/feedback.h"
#include "ui/toolkit/fields.h"
#include "ui/toolkit/file_dialog.h"
#include "ui/toolkit/layout.h"
#include "ui/toolkit/lists.h"
#include "ui/toolkit/menus.h"
#include "ui/toolkit/range_slider.h"
#include "ui/toolkit/text.h"
#include "ui/toolkit/timeline.h"
#include "ui/toolkit/ui.h"
