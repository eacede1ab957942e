#pragma once
/// The sensor's scalar operations for automatic-differentiation numbers, so that a fit runs the sensor's own equations.
/// Include before the sensor's headers are instantiated with ceres::Jet.
#include <ceres/jet.h>

namespace ceres {

template <class T, int N>
Jet<T, N> select(bool condition, const Jet<T, N>& yes, const Jet<T, N>& no) {
  return condition ? yes : no;
}

template <class T, int N>
int table_index(const Jet<T, N>& value) {
  return static_cast<int>(value.a);
}

}  // namespace ceres
