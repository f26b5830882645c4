// Target: small texts: tables, files of joint names, and arguments of a command line (shards, numbers).
#include <stdexcept>

#include "command_line_numbers.h"
#include "core/error.h"
#include "fuzz/driver.h"
#include "import/retarget/joint_names.h"
#include "record/shard.h"
#include "record/table.h"

namespace mimicx::fuzz {
namespace {

void feed_table(const std::string& bytes) {
  std::string written;
  try {
    written = record::format_csv(record::parse_csv(bytes, "fuzz.csv"));
  } catch (const DataError&) {
    return;
  }
  if (record::format_csv(record::parse_csv(written, "fuzz.csv")) != written)
    throw std::logic_error("reads back as something else: " + written);
}

}  // namespace

std::vector<std::string> seeds() {
  return {record::format_csv({{"iteration", "reward"}, {{0, 0.1}, {1, -1e300}, {2, 1.0 / 0.0}}}),
          "# my rig\nleft_knee = Leg_L\n\nleft_knee=\"Knie\" # or so\r\nhead = Kopf",
          "3/64",
          "1.5M",
          "-500k",
          "1e6"};
}

void feed(const std::string& bytes) {
  feed_table(bytes);
  try {
    import::parse_joint_map(bytes, "fuzz.txt");
  } catch (const DataError&) {
  }
  try {
    record::shard_name(record::parse_shard(bytes));
  } catch (const std::invalid_argument&) {
  }
  tools::number_of(bytes);
  tools::whole_number_of(bytes);
  tools::natural_number_of(bytes);
}

}  // namespace mimicx::fuzz
