/// What must not pass: memory from the heap, and an error that is thrown by a library function.
#include <array>

extern "C" float* allocate(int count) {
  return new float[static_cast<unsigned>(count)];
}
extern "C" float element(const std::array<float, 3>& values, unsigned index) {
  return values.at(index);
}
