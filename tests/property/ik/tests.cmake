# SPDX-License-Identifier: MIT
elbowroom_tests(test_ik_on_samples property/ik LABEL fast
                LINK elbowroom_ik elbowroom_io TIMEOUT 120)
