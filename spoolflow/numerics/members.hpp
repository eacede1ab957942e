#pragma once
/// The members of plain structures, found by the compiler.
#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

namespace spoolflow::numerics {
namespace detail {

struct Anything {
  template <class Member>
  constexpr operator Member() const noexcept;
};

template <class Object, std::size_t... member>
constexpr bool has_members(std::index_sequence<member...> /*members*/) {
  return requires {
    Object{((void)member, Anything{})...};
  };
}

template <class Object, std::size_t count = 0>
constexpr std::size_t member_count() {
  if constexpr (has_members<Object>(std::make_index_sequence<count + 1>{})) {
    return member_count<Object, count + 1>();
  } else {
    return count;
  }
}

template <class Object>
inline constexpr bool is_array = false;
template <class Element, std::size_t size>
inline constexpr bool is_array<std::array<Element, size>> = true;

template <std::size_t count>
using Count = std::integral_constant<std::size_t, count>;

/// References to the members: one function for each number of them, which the language asks for.
template <class Object>
constexpr auto members_of(Object& /*object*/, Count<0> /*count*/) {
  return std::tie();
}
#define SPOOLFLOW_MEMBERS(count, ...)                       \
  template <class Object>                                   \
  constexpr auto members_of(Object& object, Count<count>) { \
    auto& [__VA_ARGS__] = object;                           \
    return std::tie(__VA_ARGS__);                           \
  }
SPOOLFLOW_MEMBERS(1, a)
SPOOLFLOW_MEMBERS(2, a, b)
SPOOLFLOW_MEMBERS(3, a, b, c)
SPOOLFLOW_MEMBERS(4, a, b, c, d)
SPOOLFLOW_MEMBERS(5, a, b, c, d, e)
SPOOLFLOW_MEMBERS(6, a, b, c, d, e, f)
SPOOLFLOW_MEMBERS(7, a, b, c, d, e, f, g)
SPOOLFLOW_MEMBERS(8, a, b, c, d, e, f, g, h)
SPOOLFLOW_MEMBERS(9, a, b, c, d, e, f, g, h, i)
SPOOLFLOW_MEMBERS(10, a, b, c, d, e, f, g, h, i, j)
SPOOLFLOW_MEMBERS(11, a, b, c, d, e, f, g, h, i, j, k)
SPOOLFLOW_MEMBERS(12, a, b, c, d, e, f, g, h, i, j, k, l)
SPOOLFLOW_MEMBERS(13, a, b, c, d, e, f, g, h, i, j, k, l, m)
SPOOLFLOW_MEMBERS(14, a, b, c, d, e, f, g, h, i, j, k, l, m, n)
SPOOLFLOW_MEMBERS(15, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o)
SPOOLFLOW_MEMBERS(16, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p)
SPOOLFLOW_MEMBERS(17, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q)
SPOOLFLOW_MEMBERS(18, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r)
SPOOLFLOW_MEMBERS(19, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s)
SPOOLFLOW_MEMBERS(20, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t)
SPOOLFLOW_MEMBERS(21, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u)
SPOOLFLOW_MEMBERS(22, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v)
SPOOLFLOW_MEMBERS(23, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w)
SPOOLFLOW_MEMBERS(24, a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x)
#undef SPOOLFLOW_MEMBERS

}  // namespace detail

/// A structure without constructors, base classes and built-in arrays, of up to 24 members.
template <class Object>
concept Structure = std::is_aggregate_v<Object> && !detail::is_array<Object>;

/// `visit(member)` for each, in their order.
template <Structure Object, class Visit>
constexpr void for_each_member(Object& object, const Visit& visit) {
  constexpr std::size_t count = detail::member_count<std::remove_const_t<Object>>();
  static_assert(count <= 24);
  std::apply([&visit](auto&... member) { (visit(member), ...); }, detail::members_of(object, detail::Count<count>{}));
}

/// `visit(number)` for each number, enumerator and pointer within, however deep.
template <class Object, class Visit>
constexpr void for_each_number(Object& object, const Visit& visit) {
  if constexpr (detail::is_array<std::remove_const_t<Object>>) {
    for (auto& element : object) for_each_number(element, visit);
  } else if constexpr (std::is_scalar_v<Object>) {
    visit(object);
  } else {
    for_each_member(object, [&visit](auto& member) { for_each_number(member, visit); });
  }
}

}  // namespace spoolflow::numerics
