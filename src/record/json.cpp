#include "record/json.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>

namespace mimicx::record {
namespace {

constexpr std::size_t kMaxDepth = 256;  ///< of nested brackets

/// Builds a value from the events of nlohmann's parser.
class Builder : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Builder(const std::string& text) : text_(text) {}
  Json take() { return std::move(root_); }

  bool null() override { return put(Json()); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(std::int64_t value) override { return put(value); }
  bool number_unsigned(std::uint64_t value) override { return put(value); }
  bool number_float(double value, const std::string&) override { return put(value); }
  bool string(std::string& value) override { return put(std::move(value)); }
  bool binary(nlohmann::json::binary_t&) override { return false; }  // not in JSON text
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(std::string& name) override {
    if (open_.back().contains(name)) throw JsonError('"' + name + "\" twice");
    names_.back() = std::move(name);
    return true;
  }
  bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception&) override {
    const auto end = text_.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text_.size()));
    throw JsonError("no JSON at line " + std::to_string(1 + std::count(text_.begin(), end, '\n')));
  }

 private:
  bool put(Json value) {
    if (open_.empty())
      root_ = std::move(value);
    else if (open_.back().is_object())
      open_.back()[names_.back()] = std::move(value);
    else
      open_.back().push_back(std::move(value));
    return true;
  }
  bool open(Json value) {
    if (open_.size() == kMaxDepth) throw JsonError("more than 256 levels of brackets");
    open_.push_back(std::move(value));
    names_.emplace_back();
    return true;
  }
  bool close() {
    Json value = std::move(open_.back());
    open_.pop_back();
    names_.pop_back();
    return put(std::move(value));
  }

  const std::string& text_;
  Json root_;
  std::vector<Json> open_;          ///< objects and arrays around what comes next, outermost first
  std::vector<std::string> names_;  ///< of each of these, the member that comes next
};

std::string written(const nlohmann::json& value) {
  return value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// A message completes the sentence "expected the manifest of a run, found …".
[[noreturn]] void refuse(const std::string& found) { throw JsonError(found); }

}  // namespace

// Here, so that they are compiled once.
Json::Json() = default;
Json::Json(const Json&) = default;
Json::Json(Json&&) noexcept = default;
Json& Json::operator=(const Json&) = default;
Json& Json::operator=(Json&&) noexcept = default;
Json::~Json() = default;

Json::Json(std::initializer_list<Json> values) {
  const auto pair_of = [](const Json& value) -> const std::vector<Json>* {
    const auto* elements = std::get_if<std::vector<Json>>(&value.value_);
    const bool named = elements != nullptr && elements->size() == 2 &&
                       std::holds_alternative<std::string>(elements->front().value_);
    return named ? elements : nullptr;
  };
  if (!std::all_of(values.begin(), values.end(), pair_of)) {
    value_ = std::vector<Json>(values.begin(), values.end());
    return;
  }
  value_ = std::vector<Member>();
  for (const Json& value : values) {
    const std::vector<Json>& pair = *pair_of(value);
    (*this)[std::get<std::string>(pair.front().value_)] = pair.back();
  }
}

Json Json::parse(const std::string& text) {
  Builder builder(text);
  nlohmann::json::sax_parse(text, &builder);
  return builder.take();
}

const Json* Json::find(const std::string& name) const {
  const auto* members = std::get_if<std::vector<Member>>(&value_);
  if (members == nullptr) return nullptr;
  const auto found =
      std::find_if(members->begin(), members->end(), [&](const Member& m) { return m.first == name; });
  return found == members->end() ? nullptr : &found->second;
}

Json& Json::operator[](const std::string& name) {
  if (is_null()) value_ = std::vector<Member>();
  if (const Json* there = find(name)) return const_cast<Json&>(*there);
  auto* members = std::get_if<std::vector<Member>>(&value_);
  if (members == nullptr) refuse("a value that is no object");
  return members->emplace_back(name, Json()).second;
}

const Json& Json::at(const std::string& name) const {
  const Json* there = find(name);
  if (there == nullptr) refuse("no member " + name);
  return *there;
}

const Json& Json::at(std::size_t index) const {
  const std::vector<Json>& all = elements();
  if (index >= all.size()) refuse("no element " + std::to_string(index));
  return all[index];
}

Json Json::value(const std::string& name, const Json& otherwise) const {
  const Json* there = find(name);
  return there == nullptr ? otherwise : *there;
}

const std::vector<Json::Member>& Json::items() const {
  if (!is_object()) refuse("a value that is no object");
  return std::get<std::vector<Member>>(value_);
}

const std::vector<Json>& Json::elements() const {
  if (!std::holds_alternative<std::vector<Json>>(value_)) refuse("a value that is no array");
  return std::get<std::vector<Json>>(value_);
}

void Json::push_back(Json element) {
  if (is_null()) value_ = std::vector<Json>();
  auto* elements = std::get_if<std::vector<Json>>(&value_);
  if (elements == nullptr) refuse("a value that is no array");
  elements->push_back(std::move(element));
}

bool Json::boolean() const {
  if (!is_boolean()) refuse("a value that is neither true nor false");
  return std::get<bool>(value_);
}

double Json::number() const {
  if (const auto* value = std::get_if<double>(&value_)) return *value;
  if (const auto* value = std::get_if<std::int64_t>(&value_)) return static_cast<double>(*value);
  if (const auto* value = std::get_if<std::uint64_t>(&value_)) return static_cast<double>(*value);
  refuse("a value that is no number");
}

std::int64_t Json::whole() const {
  if (const auto* value = std::get_if<std::int64_t>(&value_)) return *value;
  if (const auto* value = std::get_if<std::uint64_t>(&value_)) return static_cast<std::int64_t>(*value);
  refuse("a value that is no whole number");
}

std::uint64_t Json::natural() const {
  if (const auto* value = std::get_if<std::uint64_t>(&value_)) return *value;
  const std::int64_t value = whole();
  if (value < 0) refuse("a negative number");
  return static_cast<std::uint64_t>(value);
}

const std::string& Json::text() const {
  if (!std::holds_alternative<std::string>(value_)) refuse("a value that is no text");
  return std::get<std::string>(value_);
}

std::string Json::dump(int indent) const {
  std::string out;
  write(out, indent, 0);
  return out;
}

void Json::write(std::string& out, int indent, int level) const {
  const auto in_brackets = [&](char opening, const auto& all, char closing, const auto& write_one) {
    const auto new_line = [&](int depth) {
      if (indent >= 0) out.append("\n").append(static_cast<std::size_t>(indent * depth), ' ');
    };
    out += opening;
    for (const auto& one : all) {
      if (&one != all.data()) out += ',';
      new_line(level + 1);
      write_one(one);
    }
    if (!all.empty()) new_line(level);
    out += closing;
  };
  std::visit(
      [&](const auto& value) {
        using T = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<T, std::vector<Json>>)
          in_brackets('[', value, ']', [&](const Json& e) { e.write(out, indent, level + 1); });
        else if constexpr (std::is_same_v<T, std::vector<Member>>)
          in_brackets('{', value, '}', [&](const Member& m) {
            out.append(written(m.first)).append(indent >= 0 ? ": " : ":");
            m.second.write(out, indent, level + 1);
          });
        else
          out += written(value);
      },
      value_);
}

double number_or_nan(const Json& json) {
  return json.is_null() ? std::numeric_limits<double>::quiet_NaN() : json.get<double>();
}

Json to_json(const NamedValues& values) {
  Json json = Json::object();
  for (const auto& [name, value] : values) json[name] = number(value);
  return json;
}

NamedValues named_values(const Json& json) {
  NamedValues values;
  for (const auto& [name, value] : json.items()) values.emplace_back(name, number_or_nan(value));
  return values;
}

std::string document(const Json& members) {
  Json whole = {{"made_by", "mimicx"}};
  for (const auto& [name, value] : members.items()) whole[name] = value;
  return whole.dump(1) + "\n";
}

}  // namespace mimicx::record
