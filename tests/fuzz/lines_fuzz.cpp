// Target: small texts: tables, files of joint names, measured forces (.mot), and arguments of a command line
// (shards, numbers).
#include <stdexcept>

#include "command_line_numbers.h"
#include "core/error.h"
#include "fuzz/driver.h"
#include "import/opensim/measured_forces.h"
#include "import/retarget/joint_names.h"
#include "record/shard.h"
#include "record/table.h"

namespace mimicx::fuzz::lines {
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
          "walk\ninDegrees=no\nendheader\ntime\tground_force_vx\tground_force_vy\tground_force_vz\t"
          "ground_force_px\tground_force_py\tground_force_pz\t1_ground_force_vx\t1_ground_force_vy\t"
          "1_ground_force_vz\t1_ground_force_px\t1_ground_force_py\t1_ground_force_pz\n"
          "0\t1\t700\t3\t.1\t0\t.2\t4\t50\t6\t.3\t0\t-.2\n.01\t1\t700\t3\t.1\t0\t.2\t4\t50\t6\t.3\t0\t-.2\n",
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
    import::measured_forces_from(bytes, "fuzz.mot");
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

const Target target("lines", seeds, feed);

}  // namespace mimicx::fuzz::lines
