/* Stand-in for a test: spinlocks, which here check that they are taken and given back in turn. */
#ifndef TESTS_ZEPHYR_KERNEL_H
#define TESTS_ZEPHYR_KERNEL_H

#include <stdlib.h>

struct k_spinlock {
  int taken;
};
typedef struct {
  int key;
} k_spinlock_key_t;

static inline k_spinlock_key_t k_spin_lock(struct k_spinlock *lock) {
  if (lock->taken) abort();
  lock->taken = 1;
  return (k_spinlock_key_t){.key = 7};
}
static inline void k_spin_unlock(struct k_spinlock *lock, k_spinlock_key_t key) {
  if (!lock->taken || key.key != 7) abort();
  lock->taken = 0;
}

#endif
