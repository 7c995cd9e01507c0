# SPDX-License-Identifier: MIT
elbowroom_tests(test_toolkit gui/toolkit LABEL fast LINK elbowroom_gui_driver TIMEOUT 60)
