/// Fuzzing of the readers: every target is one function that must survive any bytes.
///
/// A target is a source file that defines the two functions below. It is linked with driver.cpp, which runs
/// it either as an ordinary program over a fixed number of mutated seeds (the default, part of ctest):
///
///     fuzz_NAME [--runs N] [--seed S] [--from K] [FILE...]
///
/// or, with clang and -DMIMICX_FUZZ=ON, under libFuzzer. Input k depends on the seed and k alone, so a
/// failure is repeated by `--from K --runs 1`; FILEs are fed as they are, before the mutated inputs.
///
/// It has no coverage feedback without libFuzzer, and no limits on time and memory: ctest limits the time,
/// and a target bounds memory by the arguments of its reader.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace mimicx::fuzz {

/// Initial inputs: small, valid, made by the target.
std::vector<std::string> seeds();

/// Feeds one input to the reader. The target catches `DataError`, the correct response to bad data; any other
/// exception is a failure.
void feed(const std::string& bytes);

/// Runs the target. @return 0 if it survived every input, 1 if not, 2 for a wrong argument
int run_fuzz(const std::vector<std::string>& arguments, const std::vector<std::string>& seeds,
             void (*feed)(const std::string&));

/// The k-th mutated input: one seed after one to eight edits (bytes changed, inserted, removed, repeated; the
/// end cut off; a piece of another seed; numbers and words that readers often trust).
std::string mutated_input(const std::vector<std::string>& seeds, std::uint64_t seed, std::uint64_t k);

}  // namespace mimicx::fuzz
