/// Containers with an `int` subscript, because bodies, frames and lanes are counted as int.
///
/// The standard containers take a `std::size_t`, and with -Wconversion every subscript by an `int` needs a
/// cast. These classes derive from the standard containers and change the subscript alone: a function of a
/// std::array or a std::vector takes them.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace mimicx {

/// An integer of any type, or a plain enumerator.
template <class I>
concept Subscript = std::integral<I> ||(std::is_enum_v<I>&& std::convertible_to<I, int>);

/// std::array of N elements, indexed by any Subscript.
template <class T, int N>
struct Array : std::array<T, static_cast<std::size_t>(N)> {
  using Base = std::array<T, static_cast<std::size_t>(N)>;
  constexpr T& operator[](Subscript auto i) { return Base::operator[](static_cast<std::size_t>(i)); }
  constexpr const T& operator[](Subscript auto i) const {
    return Base::operator[](static_cast<std::size_t>(i));
  }
};

/// std::vector, indexed by any Subscript, with sizes that may be an `int`.
template <class T>
struct List : std::vector<T> {
  using std::vector<T>::vector;
  using std::vector<T>::assign;
  using std::vector<T>::resize;
  List() = default;
  List(std::vector<T> values) : std::vector<T>(std::move(values)) {}
  explicit List(std::signed_integral auto n) : std::vector<T>(static_cast<std::size_t>(n)) {}
  List(std::signed_integral auto n, const T& value) : std::vector<T>(static_cast<std::size_t>(n), value) {}
  void resize(std::signed_integral auto n) { std::vector<T>::resize(static_cast<std::size_t>(n)); }
  void assign(std::signed_integral auto n, const T& value) {
    std::vector<T>::assign(static_cast<std::size_t>(n), value);
  }
  decltype(auto) operator[](Subscript auto i) {
    return std::vector<T>::operator[](static_cast<std::size_t>(i));
  }
  decltype(auto) operator[](Subscript auto i) const {
    return std::vector<T>::operator[](static_cast<std::size_t>(i));
  }
  /// `size` as an int.
  int count() const { return static_cast<int>(this->size()); }
};

/// One element per frame of a motion.
template <class T>
using PerFrame = List<T>;

}  // namespace mimicx
