# SPDX-License-Identifier: MIT
elbowroom_tests(test_io_read unit/io_read LABEL fast TOGETHER LINK elbowroom_io)
