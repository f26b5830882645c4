/// Declares the command line: the arguments of a subcommand, the variables that get their values, and their
/// help.
///
///     Command command = line.add("plan", "Clean motions by optimal control",
///                                "mimicx plan clip.bvh              # clip.clean.bvh beside it\n"
///                                "mimicx plan mocap/ --out out/run  # a folder, and a report");
///     command.files("FILE", a->inputs, "motions and folders of them");
///     command.path("--out", a->out, "folder of the run").required();
///     command.number("--samples", a->samples, kFromZero, "training budget per motion");
///     command.one_of("--rate", a->rate, {"30", "input"}, "frame rate of the copies");
///     command.action([a] { return plan(*a); });
///
/// Parsing writes to the declared variables, so they must outlive `CommandLine::run`. Their initial value is
/// the default; the help prints it if it is a valid value. Names with dashes are options, others are
/// positional. An error is one line: the option, what was expected, what was found.
///
/// Only arguments.cpp includes the command-line library, because it is slow to compile.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace mimicx::tools {

/// The work of a subcommand. @return the exit status
using Action = std::function<int()>;

/// The numbers that an option takes; never NaN or an infinity.
struct Range {
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  bool above = false;  ///< `least` itself is excluded
};
inline constexpr Range kAnyNumber{}, kFromZero{0.0}, kFromOne{1.0},
    kPositive{0.0, std::numeric_limits<double>::infinity(), true};

/// {name in earlier versions, name today} of the values of an option.
using FormerNames = std::vector<std::pair<std::string, std::string>>;

/// A declared argument, to set further properties.
class Option {
 public:
  explicit Option(CLI::Option* option) : option_(option) {}
  Option& required();
  /// Not allowed together with the other one.
  Option& excludes(const Option& other);
  /// Not allowed without the other one.
  Option& needs(const Option& other);
  /// Sets the default that the help prints.
  Option& defaults_to(const std::string& text);

 private:
  CLI::Option* option_;
};

/// A subcommand. Every function declares an argument.
class Command {
 public:
  Command(CLI::App* app, Action* action) : app_(app), action_(action) {}

  /// Sets the work of this subcommand.
  void action(Action work);
  /// Whether the line has this option; after parsing, so in the work.
  bool given(const std::string& option) const;

  Option file(const std::string& name, std::filesystem::path& file, const std::string& help);
  /// One file or more.
  Option files(const std::string& name, std::vector<std::string>& files, const std::string& help);
  /// Any number of files.
  Option optional_files(const std::string& name, std::vector<std::string>& files, const std::string& help);
  /// A path; not empty.
  Option path(const std::string& name, std::filesystem::path& path, const std::string& help);
  /// The path of a folder, which may be missing.
  Option folder(const std::string& name, std::filesystem::path& path, const std::string& help);
  /// The path of an existing file.
  Option existing(const std::string& name, std::filesystem::path& path, const std::string& help);
  /// One or more paths after one name.
  Option paths(const std::string& name, std::vector<std::string>& paths, const std::string& help);

  /// Whole numbers may be written as 3M or 500k.
  Option number(const std::string& name, int& value, const Range& range, const std::string& help);
  Option number(const std::string& name, std::int64_t& value, const Range& range, const std::string& help);
  Option number(const std::string& name, std::uint64_t& value, const Range& range, const std::string& help);
  Option number(const std::string& name, double& value, const Range& range, const std::string& help);
  Option number(const std::string& name, std::optional<int>& value, const Range& range,
                const std::string& help);
  Option number(const std::string& name, std::optional<std::int64_t>& value, const Range& range,
                const std::string& help);
  Option number(const std::string& name, std::optional<double>& value, const Range& range,
                const std::string& help);
  /// Numbers separated by commas.
  Option numbers(const std::string& name, std::vector<double>& values, const Range& range,
                 const std::string& help);

  /// @param no  the name that makes the value false; empty: none
  Option flag(const std::string& yes, bool& value, const std::string& help, const std::string& no = {});

  /// A text that `take` parses. @param form its form, for the help
  Option text(const std::string& name, const std::function<void(const std::string&)>& take,
              const std::string& form, const std::string& help);
  /// Any text, repeatable. @param form its form, for the help
  Option texts(const std::string& name, std::vector<std::string>& values, const std::string& form,
               const std::string& help);
  /// Any texts, separated by commas.
  Option list(const std::string& name, std::vector<std::string>& values, const std::string& form,
              const std::string& help);
  /// Some of `names`, separated by commas.
  Option some_of(const std::string& name, std::vector<std::string>& values,
                 const std::vector<std::string>& names, const std::string& help);
  Option one_of(const std::string& name, std::string& value, const std::vector<std::string>& names,
                const std::string& help);
  /// One of several values by their names.
  template <class T>
  Option choice(const std::string& name, T& value, const std::vector<std::pair<std::string, T>>& choices,
                const std::string& help) {
    return choice_of<T>(
        name, value, choices, [&value](T chosen) { value = chosen; }, help);
  }
  /// The same for a value that `take` gets. It may set variables of arguments that are declared later: these
  /// write to them after it, wherever they stand on the line. @param former  earlier names, with today's;
  /// such a name is accepted, and one line on standard error says what it is called now
  template <class T>
  Option choice_of(const std::string& name, T initial, const std::vector<std::pair<std::string, T>>& choices,
                   const std::function<void(T)>& take, const std::string& help,
                   const FormerNames& former = {}) {
    std::vector<std::string> names;
    std::string now;
    for (const auto& [text, meant] : choices) {
      names.push_back(text);
      if (meant == initial) now = text;
    }
    return choose(
        name, names, now, [take, choices](std::size_t i) { take(choices[i].second); }, help, former);
  }

 private:
  Option choose(const std::string& name, const std::vector<std::string>& names, const std::string& now,
                const std::function<void(std::size_t)>& take, const std::string& help,
                const FormerNames& former = {});

  CLI::App* app_;
  Action* action_;
};

/// The whole line: `PROGRAM [--version] COMMAND ...`.
class CommandLine {
 public:
  CommandLine(const std::string& program, const std::string& purpose, const std::string& examples,
              const std::string& version, const std::string& footer);
  CommandLine(const CommandLine&) = delete;
  CommandLine& operator=(const CommandLine&) = delete;
  ~CommandLine();

  /// @param purpose   one line, for the list of commands
  /// @param examples  first lines of the command's own help
  /// @param more      further text of the help
  Command add(const std::string& name, const std::string& purpose, const std::string& examples,
              const std::string& more = {});

  /// Parses the line, then prints help or an error, or does the action of the command.
  /// @return the exit status; kWrongUsage for a wrong line
  int run(int argc, const char* const* argv);

 private:
  struct Heads;
  std::shared_ptr<Heads> heads_;
  std::unique_ptr<CLI::App> app_;
  Action action_;
};

}  // namespace mimicx::tools
