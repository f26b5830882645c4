#include <iostream>

#include "commands.h"
#include "core/npz.h"
#include "pipeline/audit/audit_file.h"
#include "pipeline/preparation.h"

namespace mimicx {

int run_audit(const std::vector<std::string>& inputs, bool poses_alone, const std::filesystem::path& json) {
  std::vector<AuditedFile> files;
  bool all_good = true;
  std::cout << audit_table_head();
  for (const std::string& path : expand_inputs(inputs)) {
    try {
      files.push_back({path, audit_file(path, poses_alone)});
      for (const Audit& audit : files.back().audits) {
        std::cout << format_audit(path, audit);
        all_good = all_good && audit.failures.empty();
      }
    } catch (const std::exception& error) {
      std::cerr << path << ": left out: " << error.what() << '\n';
      all_good = false;
    }
  }
  if (!json.empty()) write_file_atomically(json, audit_json(files));
  return all_good ? kAllGood : kSomeFailed;
}

}  // namespace mimicx
