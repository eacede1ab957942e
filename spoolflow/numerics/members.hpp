#pragma once
/// The members of plain structures, found by the compiler.
#include <array>
#include <cstddef>
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

/// One case for each number of members, which the language asks for.
template <std::size_t count, class Object, class Visit>
constexpr void visit_1_to_8(Object& object, const Visit& visit) {
  if constexpr (count == 1) {
    auto& [a] = object;
    (visit(a));
  } else if constexpr (count == 2) {
    auto& [a, b] = object;
    (visit(a), visit(b));
  } else if constexpr (count == 3) {
    auto& [a, b, c] = object;
    (visit(a), visit(b), visit(c));
  } else if constexpr (count == 4) {
    auto& [a, b, c, d] = object;
    (visit(a), visit(b), visit(c), visit(d));
  } else if constexpr (count == 5) {
    auto& [a, b, c, d, e] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e));
  } else if constexpr (count == 6) {
    auto& [a, b, c, d, e, f] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f));
  } else if constexpr (count == 7) {
    auto& [a, b, c, d, e, f, g] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g));
  } else if constexpr (count == 8) {
    auto& [a, b, c, d, e, f, g, h] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h));
  }
}

template <std::size_t count, class Object, class Visit>
constexpr void visit_9_to_16(Object& object, const Visit& visit) {
  if constexpr (count == 9) {
    auto& [a, b, c, d, e, f, g, h, i] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i));
  } else if constexpr (count == 10) {
    auto& [a, b, c, d, e, f, g, h, i, j] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j));
  } else if constexpr (count == 11) {
    auto& [a, b, c, d, e, f, g, h, i, j, k] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k));
  } else if constexpr (count == 12) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l));
  } else if constexpr (count == 13) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m));
  } else if constexpr (count == 14) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n));
  } else if constexpr (count == 15) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n), visit(o));
  } else if constexpr (count == 16) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n), visit(o), visit(p));
  }
}

template <std::size_t count, class Object, class Visit>
constexpr void visit_17_to_24(Object& object, const Visit& visit) {
  if constexpr (count == 17) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n), visit(o), visit(p), visit(q));
  } else if constexpr (count == 18) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n), visit(o), visit(p), visit(q), visit(r));
  } else if constexpr (count == 19) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n), visit(o), visit(p), visit(q), visit(r), visit(s));
  } else if constexpr (count == 20) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n), visit(o), visit(p), visit(q), visit(r), visit(s), visit(t));
  } else if constexpr (count == 21) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n), visit(o), visit(p), visit(q), visit(r), visit(s), visit(t), visit(u));
  } else if constexpr (count == 22) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n), visit(o), visit(p), visit(q), visit(r), visit(s), visit(t), visit(u), visit(v));
  } else if constexpr (count == 23) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n), visit(o), visit(p), visit(q), visit(r), visit(s), visit(t), visit(u), visit(v),
     visit(w));
  } else if constexpr (count == 24) {
    auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, s, t, u, v, w, x] = object;
    (visit(a), visit(b), visit(c), visit(d), visit(e), visit(f), visit(g), visit(h), visit(i), visit(j), visit(k),
     visit(l), visit(m), visit(n), visit(o), visit(p), visit(q), visit(r), visit(s), visit(t), visit(u), visit(v),
     visit(w), visit(x));
  }
}

}  // namespace detail

/// A structure without constructors, base classes and built-in arrays, of up to 24 members.
template <class Object>
concept Structure = std::is_aggregate_v<Object> && !detail::is_array<Object>;

/// `visit(member)` for each, in their order.
template <Structure Object, class Visit>
constexpr void for_each_member(Object& object, const Visit& visit) {
  constexpr std::size_t count = detail::member_count<std::remove_const_t<Object>>();
  static_assert(count <= 24);
  if constexpr (count == 0) {
    (void)object;
    (void)visit;
  } else if constexpr (count <= 8) {
    detail::visit_1_to_8<count>(object, visit);
  } else if constexpr (count <= 16) {
    detail::visit_9_to_16<count>(object, visit);
  } else {
    detail::visit_17_to_24<count>(object, visit);
  }
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
