/// What must not pass: arithmetic in double, which a single-precision unit computes in software.
extern "C" float half(float value) {
  return value * 0.5;
}
