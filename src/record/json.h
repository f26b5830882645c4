/// JSON as manifests, metrics and reports use it: members in the order they were put in.
///
///     Json json = {{"name", "walk"}, {"frames", 120}, {"metrics", Json::object()}};
///     json["metrics"]["MPJPE"] = number(12.5);
///     write(json.dump(1));
///     const int frames = Json::parse(text).at("frames");
///
/// A list in braces is an object where all its elements are pairs that begin with a text, else an array. Text
/// and numbers are written and parsed by nlohmann's library. Only json.cpp includes it, because it takes ten
/// seconds to compile. Bytes that are no UTF-8 are replaced.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/named_values.h"

namespace mimicx::record {

/// A text that is no JSON, or a value that is missing or of another type.
struct JsonError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class Json {
 public:
  using Member = std::pair<std::string, Json>;

  Json();  ///< null
  Json(const Json&);
  Json(Json&&) noexcept;
  Json& operator=(const Json&);
  Json& operator=(Json&&) noexcept;
  ~Json();
  Json(std::nullptr_t) {}
  Json(const char* text) : value_(std::string(text)) {}
  Json(std::string text) : value_(std::move(text)) {}
  Json(std::string_view text) : value_(std::string(text)) {}
  template <class T>
  requires std::is_arithmetic_v<T> Json(T value) {
    if constexpr (std::is_same_v<T, bool>)
      value_ = value;
    else if constexpr (std::is_floating_point_v<T>)
      value_ = static_cast<double>(value);
    else if constexpr (std::is_signed_v<T>)
      value_ = static_cast<std::int64_t>(value);
    else
      value_ = static_cast<std::uint64_t>(value);
  }
  /// An array of the elements of a vector or std::array.
  template <class Range, class = typename Range::value_type>
  requires(!std::is_convertible_v<Range, std::string_view>) Json(const Range& range)
      : value_(std::vector<Json>(range.begin(), range.end())) {}
  Json(std::vector<Json> elements) : value_(std::move(elements)) {}
  Json(std::initializer_list<Json> values);

  static Json array() { return Json(std::vector<Json>()); }
  static Json object() { return Json(nullptr, std::vector<Member>()); }
  /// @throws JsonError
  static Json parse(const std::string& text);

  /// @param indent  blanks per level; negative: all in one line
  std::string dump(int indent = -1) const;

  bool is_null() const { return std::holds_alternative<std::nullptr_t>(value_); }
  bool is_boolean() const { return std::holds_alternative<bool>(value_); }
  bool is_number() const { return !is_null() && !is_boolean() && value_.index() < 5; }
  bool is_object() const { return std::holds_alternative<std::vector<Member>>(value_); }
  bool contains(const std::string& name) const { return find(name) != nullptr; }

  /// The member; if it is missing, a null is added. A null value becomes an object.
  Json& operator[](const std::string& name);
  Json& operator[](const char* name) { return (*this)[std::string(name)]; }
  /// @throws JsonError if it is missing
  const Json& at(const std::string& name) const;
  /// The element of an array. @throws JsonError if there are fewer, or this is none
  const Json& at(std::size_t index) const;
  /// The member, or `otherwise` if it is missing.
  Json value(const std::string& name, const Json& otherwise) const;
  /// @throws JsonError if this is no object, or no array
  const std::vector<Member>& items() const;
  const std::vector<Json>& elements() const;
  /// A null value becomes an array.
  void push_back(Json element);

  /// @throws JsonError for a value of another type
  template <class T>
  T get() const {
    if constexpr (std::is_same_v<T, bool>)
      return boolean();
    else if constexpr (std::is_same_v<T, std::string>)
      return text();
    else if constexpr (std::is_floating_point_v<T>)
      return static_cast<T>(number());
    else if constexpr (std::is_unsigned_v<T>)
      return static_cast<T>(natural());
    else if constexpr (std::is_integral_v<T>)
      return static_cast<T>(whole());
    else
      return list<T>();
  }
  template <class T>
  requires(std::is_arithmetic_v<T> && !std::is_same_v<T, char>) operator T() const { return get<T>(); }

  /// Whether both have the same text.
  friend bool operator==(const Json& a, const Json& b) { return a.dump() == b.dump(); }

 private:
  Json(std::nullptr_t, std::vector<Member> members) : value_(std::move(members)) {}

  const Json* find(const std::string& name) const;
  bool boolean() const;
  double number() const;
  std::int64_t whole() const;
  std::uint64_t natural() const;
  const std::string& text() const;
  /// A vector, or an array of that many elements.
  template <class T>
  T list() const {
    T values{};
    const std::vector<Json>& all = elements();
    if constexpr (requires { values.resize(all.size()); }) values.resize(all.size());
    if (values.size() != all.size())
      throw JsonError("expected " + std::to_string(values.size()) + " elements");
    for (std::size_t i = 0; i < all.size(); ++i) values[i] = all[i].get<typename T::value_type>();
    return values;
  }
  void write(std::string& out, int indent, int level) const;

  std::variant<std::nullptr_t, bool, std::int64_t, std::uint64_t, double, std::string, std::vector<Json>,
               std::vector<Member>>
      value_;
};

/// The number; null for NaN and infinities, which JSON does not have.
inline Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }
/// The reverse: NaN for null. @throws JsonError
double number_or_nan(const Json& json);

/// A member per value, a `number` each.
Json to_json(const NamedValues& values);
/// The reverse. @throws JsonError
NamedValues named_values(const Json& json);

/// A document for users: {"made_by": "mimicx", members…}. outputs.h recognises our files by this opening.
std::string document(const Json& members);

}  // namespace mimicx::record
