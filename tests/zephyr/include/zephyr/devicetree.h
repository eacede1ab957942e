/* Stand-in for a test: a devicetree with two nodes of the driver's, one with the two pages of the test's flash, one without. */
#ifndef TESTS_ZEPHYR_DEVICETREE_H
#define TESTS_ZEPHYR_DEVICETREE_H

#include <stdint.h>

#define TEST_PAGE_BYTES 65536
extern uint64_t test_flash[2][TEST_PAGE_BYTES / 8];

#define DT_INST_FOREACH_STATUS_OKAY(fn) fn(0) fn(1)
#define DT_INST_NODE_HAS_PROP(inst, prop) TEST_HAS_##inst##_##prop
#define TEST_HAS_0_parameter_pages 1
#define TEST_HAS_1_parameter_pages 0
#define DT_INST_PHANDLE_BY_IDX(inst, prop, idx) TEST_NODE_##inst##_##prop##_##idx
#define TEST_NODE_0_parameter_pages_0 0
#define TEST_NODE_0_parameter_pages_1 1
#define DT_FIXED_PARTITION_ADDR(node) ((uintptr_t)test_flash[node])
#define DT_REG_SIZE(node) TEST_PAGE_BYTES

#define COND_CODE_1(flag, yes, no) TEST_COND(flag, yes, no)
#define TEST_COND(flag, yes, no) TEST_COND_##flag(yes, no)
#define TEST_COND_1(yes, no) TEST_BARE yes
#define TEST_COND_0(yes, no) TEST_BARE no
#define TEST_BARE(...) __VA_ARGS__

#endif
