#include <algorithm>
#include <iostream>
#include <memory>

#include "audit/certificate/certificate.h"
#include "commands.h"
#include "core/error.h"
#include "core/file.h"
#include "files/inputs.h"
#include "record/json.h"
#include "record/outputs.h"
#include "record/run_folder.h"
#include "record/utf8_names.h"
#include "shared_arguments.h"
#include "standard_streams.h"

namespace mimicx::tools {
namespace {

struct CertifyArguments {
  std::vector<std::string> inputs;
  std::filesystem::path out, json;
  bool replay = false, force = false;
};

int replay(const CertifyArguments& a) {
  if (!is_standard_output(a.json)) record::Outputs(a.inputs, a.force).claim(a.json, record::kJsonOpening);
  std::ostream& out = table_stream(a.json);
  record::Json rows = record::Json::array();
  bool all_good = true;
  for (const std::string& path : a.inputs) {
    try {
      const audit::CertificateReplay found = audit::replay_certificate(path);
      const bool good = found.first_state < 0 && found.first_step < 0;
      out << path << ": " << found.steps << " steps, " << (good ? "the same bits" : "other bits");
      if (found.first_state >= 0) out << "; states differ after step " << found.first_state;
      if (found.first_step >= 0) out << "; forces differ in step " << found.first_step;
      out << '\n';
      rows.push_back({{"certificate", record::to_utf8(path)},
                      {"steps", found.steps},
                      {"same_bits", good},
                      {"first_state", found.first_state},
                      {"first_step", found.first_step}});
      all_good = all_good && good;
    } catch (const std::exception& error) {
      std::cerr << path << ": left out: " << reason_of(error) << '\n';
      all_good = false;
    }
  }
  if (!a.json.empty()) write_json(a.json, record::document({{"certificates", rows}}));
  return all_good ? kAllGood : kSomeFailed;
}

/// Leaves out the parts of motions (RunFolder::part) that lie in folders, and says so.
void leave_out_parts(const CertifyArguments& a, std::vector<files::MotionInput>& inputs) {
  const auto is_given = [&](const std::string& path) {
    return std::any_of(a.inputs.begin(), a.inputs.end(), [&](const std::string& typed) {
      std::error_code none;
      return std::filesystem::equivalent(typed, path, none);
    });
  };
  const auto count = std::erase_if(inputs, [&](const files::MotionInput& input) {
    return record::RunFolder::is_part_name(input.name) && audit::steps_of_motion(input.path).empty() &&
           !is_given(input.path);
  });
  if (count > 0)
    std::cerr << "certify: " << count << (count == 1 ? " part" : " parts")
              << " of motions left out (NAME.partK.npz): parts have no physics steps\n";
}

int certify(const CertifyArguments& a) {
  if (a.replay) return replay(a);
  if (!a.json.empty()) throw UsageError("certify: --json has the results of --replay alone");
  if (a.out.empty()) throw UsageError("certify: --out is needed: the folder of the certificates");
  std::vector<files::MotionInput> inputs = files::find_motions(a.inputs, {}, &std::cerr);
  leave_out_parts(a, inputs);
  const auto certificate_path = [&](const files::MotionInput& input) {
    return a.out / (input.name + ".cert");
  };
  const auto copy_path = [&](const files::MotionInput& input) { return a.out / (input.name + ".npz"); };
  record::Outputs outputs(files::paths_of(inputs), a.force);
  for (const files::MotionInput& input : inputs) {
    outputs.claim(certificate_path(input), "MIMICERT");
    outputs.claim(copy_path(input));
  }
  bool all_good = true;
  for (const files::MotionInput& input : inputs) {
    try {
      const std::string certificate = audit::certify_file(input.path);
      make_folder(certificate_path(input).parent_path());
      write_file_atomically(certificate_path(input), certificate);
      write_file_atomically(copy_path(input), read_file(input.path));
    } catch (const std::exception& error) {
      std::cerr << input.path << ": left out: " << reason_of(error) << '\n';
      all_good = false;
    }
  }
  return all_good ? kAllGood : kSomeFailed;
}

}  // namespace

void declare_certify(CommandLine& line) {
  const auto a = std::make_shared<CertifyArguments>();
  Command command =
      line.add("certify", "Write certificates of motions, which `verify` checks without this program",
               "mimicx plan DIR --substeps --out out/run\n"
               "mimicx certify out/run/motions --out out/certificates\n"
               "verify out/certificates",
               "A motion needs its physics steps, substeps/NAME.npz of the same run (--substeps).");
  command.files("FILE", a->inputs,
                "motions of a run with --substeps, and folders of them; with --replay certificates");
  command.path("--out", a->out,
               "folder of the certificates, NAME.cert each, and of copies of the motions, NAME.npz");
  command.flag("--replay", a->replay,
               "simulate the controls of certificates again: do they give the same bits?");
  add_json(command, a->json);
  add_force(command, a->force);
  command.action([a] { return certify(*a); });
}

}  // namespace mimicx::tools
