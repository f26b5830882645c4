#include "fuzz/driver.h"

#include <cstdint>
#include <exception>
#include <fstream>
#include <iostream>
#include <iterator>

namespace mimicx::fuzz {
namespace {

constexpr int kSurvived = 0, kFailed = 1, kWrongUsage = 2;

/// @param what  how to reproduce the input, for the message of a failure
bool survives(const std::string& bytes, const std::string& what, Target::Feed* feed) {
  try {
    feed(bytes);
    return true;
  } catch (const std::exception& e) {
    std::cerr << what << ": " << e.what() << '\n';
  }
  return false;
}

}  // namespace

Target::Target(const std::string& name, Seeds* seeds_of_it, Feed* feeder) : seeds(seeds_of_it), feed(feeder) {
  targets().emplace(name, *this);
}

std::map<std::string, Target>& targets() {
  static std::map<std::string, Target> all;
  return all;
}

int run_fuzz(const std::vector<std::string>& arguments, const std::vector<std::string>& seeds,
             Target::Feed* feed) {
  std::uint64_t runs = 10000, seed = 1, from = 0;
  std::vector<std::string> files;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    std::uint64_t* value = name == "--runs"   ? &runs
                           : name == "--seed" ? &seed
                           : name == "--from" ? &from
                                              : nullptr;
    if (value == nullptr) {
      files.push_back(name);
    } else if (++i < arguments.size() && !arguments[i].empty() &&
               arguments[i].find_first_not_of("0123456789") == std::string::npos &&
               arguments[i].size() < 19) {
      *value = std::stoull(arguments[i]);
    } else {
      std::cerr << name << " needs a number\n";
      return kWrongUsage;
    }
  }
  for (const std::string& name : files) {
    std::ifstream in(name, std::ios::binary);
    if (!in) {
      std::cerr << name << ": cannot be read\n";
      return kWrongUsage;
    }
    if (!survives({std::istreambuf_iterator<char>(in), {}}, name, feed)) return kFailed;
  }
  for (std::size_t i = 0; i < seeds.size(); ++i)
    if (!survives(seeds[i], "seed " + std::to_string(i), feed)) return kFailed;
  for (std::uint64_t k = from; k < from + runs; ++k)
    if (!survives(mutated_input(seeds, seed, k),
                  "--seed " + std::to_string(seed) + " --from " + std::to_string(k), feed))
      return kFailed;
  std::cout << seeds.size() << " seeds and " << runs << " mutated inputs survived\n";
  return kSurvived;
}

}  // namespace mimicx::fuzz
