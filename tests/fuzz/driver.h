/// Fuzzing of the readers: every target is one function that must survive any bytes.
///
/// A target is a source file that defines a `Target`. All are one program, which feeds a target a fixed
/// number of mutated seeds (the default, part of ctest):
///
///     fuzz_all TARGET [--runs N] [--seed S] [--from K] [FILE...]
///
/// With clang and -DMIMICX_FUZZ=ON each is a libFuzzer program of its own, fuzz_TARGET. Input k depends on
/// the seed and k alone, so a failure is repeated by `--from K --runs 1`; FILEs are fed as they are, before
/// the mutated inputs.
///
/// It has no coverage feedback without libFuzzer, and no limits on time and memory: ctest limits the time,
/// and a target bounds memory by the arguments of its reader.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace mimicx::fuzz {

/// A reader under test, with static storage. The constructor registers it in `targets`.
struct Target {
  using Seeds = std::vector<std::string>();
  using Feed = void(const std::string&);

  Target(const std::string& name, Seeds* seeds_of_it, Feed* feeder);

  Seeds* seeds;  ///< initial inputs: small, valid, made by the target
  /// Feeds one input to the reader. It catches `DataError`, the correct response to bad data; any other
  /// exception is a failure.
  Feed* feed;
};

/// The targets of this program by their names.
std::map<std::string, Target>& targets();

/// Runs the target. @return 0 if it survived every input, 1 if not, 2 for a wrong argument
int run_fuzz(const std::vector<std::string>& arguments, const std::vector<std::string>& seeds,
             Target::Feed* feed);

/// The k-th mutated input: one seed after one to eight edits (bytes changed, inserted, removed, repeated; the
/// end cut off; a piece of another seed; numbers and words that readers often trust).
std::string mutated_input(const std::vector<std::string>& seeds, std::uint64_t seed, std::uint64_t k);

}  // namespace mimicx::fuzz
