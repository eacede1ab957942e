#include "c_board.h"

#include "board.hpp"

extern "C" {

void board_print(const char* name, std::uint32_t number) {
  board::print(name, number);
}
void board_start_ticks() {
  board::start_ticks();
}
std::uint32_t board_ticks() {
  return board::ticks_left;
}
std::uint32_t board_instructions_since(std::uint32_t ticks) {
  return board::instructions((ticks - board::ticks_left) & 0xFFFFFFU);
}
}
