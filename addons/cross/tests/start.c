/* Start-up of QEMU's mps2 boards in C alone: vectors, floating-point unit, memory, main, exit with its status. */
#include <stdint.h>

extern uint32_t stored_data[], first_data[], last_data[], first_bss[], last_bss[], stack_top[];
int main(void);

static void exit_with(uint32_t status) {
  const uint32_t block[2] = {0x20026U, status};
  register uint32_t r0 __asm__("r0") = 0x20U;
  register const uint32_t* r1 __asm__("r1") = block;
  __asm__ volatile("bkpt 0xAB" : "+r"(r0) : "r"(r1) : "memory");
}

void reset(void) {
  const uint32_t* from = stored_data;
#ifdef __ARM_FP
  *(volatile uint32_t*)0xE000ED88U |= 0xFU << 20U;
  __asm__ volatile("dsb\n isb" ::: "memory");
#endif
  for (volatile uint32_t* to = first_data; to != last_data; ++to) *to = *from++;
  for (volatile uint32_t* to = first_bss; to != last_bss; ++to) *to = 0U;
  exit_with((uint32_t)main());
  for (;;) {
  }
}

static void fault(void) {
  exit_with(99U);
  for (;;) {
  }
}

typedef void (*handler)(void);
static const struct {
  const uint32_t* stack;
  handler handlers[15];
} vectors __attribute__((section(".isr_vector"), used)) = {
    stack_top,
    {reset, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault, fault}};
