# SPDX-License-Identifier: MIT
elbowroom_tests(test_anatomy_on_samples property/anatomy LABEL fast
                LINK elbowroom_anatomy elbowroom_io TIMEOUT 120)
