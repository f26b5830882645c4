#include "arguments.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <map>
#include <sstream>
#include <system_error>

#include "command_line_numbers.h"
#include "command_text.h"
#include "commands.h"
#include "record/table.h"

namespace mimicx::tools {
namespace {

constexpr std::size_t kNameColumn = 30, kWidth = 100;  ///< of the help, characters
constexpr std::size_t kLongestNames =
    32;  ///< of all names of an option that are listed beside it; longer lists follow its description

[[noreturn]] void refuse(const std::string& name, const std::string& expected, const std::string& found) {
  throw CLI::ValidationError(name, "expected " + expected + ", found " + (found.empty() ? "nothing" : found));
}

/// Appends a text to the name of an option in the help.
void append_text(CLI::Option* option, const std::string& text) {
  if (!text.empty()) option->option_text(option->get_option_text() + " " + text);
}

std::string default_text(const std::string& value) { return value.empty() ? "" : "[" + value + "]"; }

bool holds(const Range& range, double value) {
  return (range.above ? value > range.least : value >= range.least) && value <= range.most;
}

std::string words_of(const Range& range) {
  const auto digits = [](double value) { return record::format_number(value); };
  if (range.above) return " above " + digits(range.least);
  if (std::isinf(range.least)) return std::isinf(range.most) ? "" : " up to " + digits(range.most);
  return " from " + digits(range.least) + (std::isinf(range.most) ? " on" : " to " + digits(range.most));
}

template <class T>
std::optional<T> parsed(const std::string& text);
template <>
std::optional<double> parsed(const std::string& text) {
  return number_of(text);
}
template <>
std::optional<std::int64_t> parsed(const std::string& text) {
  return whole_number_of(text);
}
template <>
std::optional<std::uint64_t> parsed(const std::string& text) {
  return natural_number_of(text);
}
template <>
std::optional<int> parsed(const std::string& text) {
  const std::optional<std::int64_t> whole = whole_number_of(text);
  if (!whole || *whole != static_cast<int>(*whole)) return std::nullopt;
  return static_cast<int>(*whole);
}

template <class T>
constexpr const char* kKind = std::is_integral_v<T> ? "a whole number" : "a number";

/// @throws CLI::ValidationError if the text is no number in the range
template <class T>
T checked_number(const std::string& name, const Range& range, const std::string& text) {
  const std::optional<T> value = parsed<T>(text);
  if (!value || !holds(range, static_cast<double>(*value))) refuse(name, kKind<T> + words_of(range), text);
  return *value;
}

std::string digits_of(double value) { return record::format_number(value); }
template <class T>
std::string digits_of(T value) {
  return std::to_string(value);
}

/// @param take  gets the one value
CLI::Option* add_single(CLI::App* app, const std::string& name, const std::string& form,
                        const std::function<void(const std::string&)>& take, const std::string& help) {
  CLI::Option* option = app->add_option(
      name,
      [take](const CLI::results_t& texts) {
        take(texts.front());
        return true;
      },
      help);
  append_text(option, form);
  return option;
}

/// @param many  several values may follow one name
CLI::Option* add_many(CLI::App* app, const std::string& name, const std::string& form, bool many,
                      const std::function<void(const std::vector<std::string>&)>& take,
                      const std::string& help) {
  CLI::Option* option = app->add_option(
      name,
      [take](const CLI::results_t& texts) {
        take(texts);
        return true;
      },
      help);
  option->expected(CLI::detail::expected_max_vector_size);
  option->allow_extra_args(many);
  append_text(option, form);
  return option;
}

template <class T, class Value>
Option add_number(CLI::App* app, const std::string& name, Value& value, const std::optional<T>& now,
                  const Range& range, const std::string& help) {
  CLI::Option* option = add_single(
      app, name, std::is_integral_v<T> ? "N" : "NUMBER",
      [&value, name, range](const std::string& text) { value = checked_number<T>(name, range, text); }, help);
  if (now && holds(range, static_cast<double>(*now))) append_text(option, default_text(digits_of(*now)));
  return Option(option);
}

/// Lists the names beside the option if they are short, else after its description.
struct Names {
  std::string form, help;
};
Names shown(const std::vector<std::string>& names, const std::string& help) {
  const std::string form = joined(names, "|");
  if (form.size() <= kLongestNames) return {form, help};
  return {"NAME", help + ": " + joined(names, ", ")};
}

std::size_t place_of(const std::string& name, const std::vector<std::string>& names,
                     const std::string& text) {
  const auto found = std::find(names.begin(), names.end(), text);
  if (found == names.end()) refuse(name, joined(names, ", "), text);
  return static_cast<std::size_t>(found - names.begin());
}

void require_path(const std::string& name, const std::string& text) {
  if (text.empty()) refuse(name, "a path", text);
}

}  // namespace

Option& Option::required() {
  option_->required();
  if (option_->nonpositional()) append_text(option_, "(required)");
  return *this;
}

Option& Option::excludes(const Option& other) {
  option_->excludes(other.option_);
  return *this;
}

Option& Option::needs(const Option& other) {
  option_->needs(other.option_);
  return *this;
}

Option& Option::defaults_to(const std::string& text) {
  append_text(option_, default_text(text));
  return *this;
}

void Command::action(Action work) {
  app_->callback([action = action_, work = std::move(work)] { *action = work; });
}

bool Command::given(const std::string& option) const { return app_->count(option) > 0; }

Option Command::file(const std::string& name, std::filesystem::path& file, const std::string& help) {
  return Option(add_single(
                    app_, name, "",
                    [&file, name](const std::string& text) {
                      require_path(name, text);
                      file = text;
                    },
                    help))
      .required();
}

Option Command::files(const std::string& name, std::vector<std::string>& files, const std::string& help) {
  return optional_files(name, files, help).required();
}

Option Command::optional_files(const std::string& name, std::vector<std::string>& files,
                               const std::string& help) {
  return Option(add_many(
      app_, name, "", true,
      [&files, name](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) require_path(name, text);
        files = texts;
      },
      help));
}

Option Command::folder(const std::string& name, std::filesystem::path& path, const std::string& help) {
  return Option(add_single(
      app_, name, "PATH",
      [&path, name](const std::string& text) {
        require_path(name, text);
        std::error_code none;
        if (std::filesystem::exists(text, none) && !std::filesystem::is_directory(text, none))
          refuse(name, "a folder", text);
        path = text;
      },
      help));
}

Option Command::path(const std::string& name, std::filesystem::path& path, const std::string& help) {
  return Option(add_single(
      app_, name, "PATH",
      [&path, name](const std::string& text) {
        require_path(name, text);
        path = text;
      },
      help));
}

Option Command::existing(const std::string& name, std::filesystem::path& path, const std::string& help) {
  return Option(add_single(
      app_, name, "FILE",
      [&path, name](const std::string& text) {
        std::error_code none;
        if (!std::filesystem::is_regular_file(text, none)) refuse(name, "an existing file", text);
        path = text;
      },
      help));
}

Option Command::paths(const std::string& name, std::vector<std::string>& paths, const std::string& help) {
  return Option(add_many(
      app_, name, "PATH...", true,
      [&paths, name](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) require_path(name, text);
        paths = texts;
      },
      help));
}

Option Command::number(const std::string& name, int& value, const Range& range, const std::string& help) {
  return add_number<int>(app_, name, value, std::optional(value), range, help);
}
Option Command::number(const std::string& name, std::int64_t& value, const Range& range,
                       const std::string& help) {
  return add_number<std::int64_t>(app_, name, value, std::optional(value), range, help);
}
Option Command::number(const std::string& name, std::uint64_t& value, const Range& range,
                       const std::string& help) {
  return add_number<std::uint64_t>(app_, name, value, std::optional(value), range, help);
}
Option Command::number(const std::string& name, double& value, const Range& range, const std::string& help) {
  return add_number<double>(app_, name, value, std::optional(value), range, help);
}
Option Command::number(const std::string& name, std::optional<int>& value, const Range& range,
                       const std::string& help) {
  return add_number<int>(app_, name, value, value, range, help);
}
Option Command::number(const std::string& name, std::optional<std::int64_t>& value, const Range& range,
                       const std::string& help) {
  return add_number<std::int64_t>(app_, name, value, value, range, help);
}
Option Command::number(const std::string& name, std::optional<double>& value, const Range& range,
                       const std::string& help) {
  return add_number<double>(app_, name, value, value, range, help);
}

Option Command::numbers(const std::string& name, std::vector<double>& values, const Range& range,
                        const std::string& help) {
  CLI::Option* option = add_many(
      app_, name, "NUMBER,...", false,
      [&values, name, range](const std::vector<std::string>& texts) {
        values.clear();
        for (const std::string& text : texts) values.push_back(checked_number<double>(name, range, text));
      },
      help);
  option->delimiter(',');
  return Option(option);
}

Option Command::flag(const std::string& yes, bool& value, const std::string& help, const std::string& no) {
  return Option(app_->add_flag_function(
      no.empty() ? yes : yes + ",!" + no, [&value](std::int64_t count) { value = count > 0; }, help));
}

Option Command::text(const std::string& name, const std::function<void(const std::string&)>& take,
                     const std::string& form, const std::string& help) {
  return Option(add_single(app_, name, form, take, help));
}

Option Command::texts(const std::string& name, std::vector<std::string>& values, const std::string& form,
                      const std::string& help) {
  return Option(add_many(
      app_, name, form, false, [&values](const std::vector<std::string>& texts) { values = texts; }, help));
}

Option Command::list(const std::string& name, std::vector<std::string>& values, const std::string& form,
                     const std::string& help) {
  CLI::Option* option = add_many(
      app_, name, form, false, [&values](const std::vector<std::string>& texts) { values = texts; }, help);
  option->delimiter(',');
  return Option(option);
}

Option Command::some_of(const std::string& name, std::vector<std::string>& values,
                        const std::vector<std::string>& names, const std::string& help) {
  CLI::Option* option = add_many(
      app_, name, "NAME,...", false,
      [&values, name, names](const std::vector<std::string>& texts) {
        for (const std::string& text : texts) place_of(name, names, text);
        values = texts;
      },
      help + ": " + joined(names, ", "));
  option->delimiter(',');
  return Option(option);
}

Option Command::one_of(const std::string& name, std::string& value, const std::vector<std::string>& names,
                       const std::string& help) {
  return choose(
      name, names, value, [&value, names](std::size_t i) { value = names[i]; }, help);
}

Option Command::choose(const std::string& name, const std::vector<std::string>& names, const std::string& now,
                       const std::function<void(std::size_t)>& take, const std::string& help,
                       const FormerNames& former) {
  const Names texts = shown(names, help);
  CLI::Option* option = add_single(
      app_, name, texts.form,
      [take, name, names, former](const std::string& text) {
        std::string today = text;
        for (const auto& [then, called] : former)
          if (text == then) today = called;
        if (today != text) std::cerr << name << " " << text << " is called " << today << " now\n";
        take(place_of(name, names, today));
      },
      texts.help);
  append_text(option, default_text(now));
  return Option(option);
}

/// The beginning of each command's help, by name.
struct CommandLine::Heads : CLI::Formatter {
  std::map<std::string, std::string> by_name;

  std::string make_description(const CLI::App* app) const override { return by_name.at(app->get_name()); }
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    const std::string name = Formatter::make_option_name(option, is_positional);
    const std::size_t no = name.find("{false}");  // the library's mark of names that set a flag to false
    return no == std::string::npos ? name : name.substr(0, no);
  }
  std::string make_option_opts(const CLI::Option* option) const override { return option->get_option_text(); }
  std::string make_option_desc(const CLI::Option* option) const override {
    return wrapped(option->get_description(), kWidth - kNameColumn);
  }
  void set(const std::string& name, const std::string& examples, const std::string& text) {
    std::istringstream lines(examples);
    std::string head;
    for (std::string line; std::getline(lines, line);) head += "  " + line + '\n';
    by_name[name] = head + '\n' + wrapped(text, kWidth) + "\n\n";
  }
};

CommandLine::CommandLine(const std::string& program, const std::string& purpose, const std::string& examples,
                         const std::string& version, const std::string& footer)
    : heads_(std::make_shared<Heads>()), app_(std::make_unique<CLI::App>(purpose)) {
  app_->name(program);
  app_->set_version_flag("--version", version);
  app_->footer(footer);
  heads_->column_width(kNameColumn);
  heads_->label("SUBCOMMAND", "COMMAND");
  heads_->set(program, examples, purpose);
  app_->formatter(heads_);
  app_->require_subcommand(1);
}

CommandLine::~CommandLine() = default;

Command CommandLine::add(const std::string& name, const std::string& purpose, const std::string& examples,
                         const std::string& more) {
  heads_->set(name, examples,
              (purpose.ends_with("?") ? purpose : purpose + ".") + (more.empty() ? "" : " " + more));
  CLI::App* command = app_->add_subcommand(name, purpose);
  command->group("Commands");
  return {command, &action_};
}

namespace {

/// ": did you mean 'adapt'?" or nothing.
std::string guess(const std::string& word, const std::vector<std::string>& words) {
  const std::string nearest = nearest_word(word, words);
  return nearest.empty() ? "" : ": did you mean " + nearest + "?";
}

bool is_option(const std::string& word) { return word.starts_with('-'); }

/// The message for an unexpected word.
std::string unknown(const std::string& word, const CLI::App& app, const CLI::App* command) {
  std::vector<std::string> words;
  if (!is_option(word) && command != nullptr) return "unexpected argument: " + word;
  if (!is_option(word)) {
    for (const CLI::App* other : app.get_subcommands([](const CLI::App*) { return true; }))
      words.push_back(other->get_name());
    return "unknown command " + word + guess(word, words);
  }
  for (const CLI::Option* option : (command != nullptr ? *command : app).get_options())
    for (const std::string& name : option->get_lnames()) words.push_back("--" + name);
  return "unknown option " + word + guess(word, words);
}

/// The message for a command line that cannot be parsed. @param command the requested one, or null
std::string complaint(const CLI::App& app, const CLI::App* command, const CLI::ParseError& error) {
  const std::vector<std::string> left = app.remaining(true);
  const auto is = [&](CLI::ExitCodes code) { return error.get_exit_code() == static_cast<int>(code); };
  if (!left.empty() && (command == nullptr || is(CLI::ExitCodes::ExtrasError)))
    return unknown(left.front(), app, command);
  if (command == nullptr) return "expected a command";
  const std::string what = error.what();
  if (!is(CLI::ExitCodes::ArgumentMismatch)) return what;
  const bool missing = what.find("missing") != std::string::npos;
  return what.substr(0, what.find(':')) + (missing ? ": expected a value, found nothing" : " is given twice");
}

}  // namespace

int CommandLine::run(int argc, const char* const* argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app_->exit(error);  // --help and --version
    const std::vector<CLI::App*> chosen = app_->get_subcommands();
    const CLI::App* command = chosen.empty() ? nullptr : chosen.front();
    const std::string who = app_->get_name() + (command == nullptr ? "" : " " + command->get_name());
    std::cerr << who << ": " << complaint(*app_, command, error) << " (" << who << " --help says more)\n";
    return kWrongUsage;
  }
  return action_();
}

}  // namespace mimicx::tools
