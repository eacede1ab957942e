/* What firmware in C needs of the board; over board.hpp. */
#ifndef C_BOARD_H
#define C_BOARD_H
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

void board_print(const char* name, uint32_t number);
void board_start_ticks(void);
/* Counting down, 24 bits. */
uint32_t board_ticks(void);
uint32_t board_instructions_since(uint32_t ticks);

#ifdef __cplusplus
}
#endif
#endif
