// Target: the verifier of certificates, which reads what anybody may send. The hash is made again, or nothing
// behind it would be read. Input: a certificate, then a motion file; the length of the certificate follows
// from its numbers of steps and of plates.
#include "audit/certificate/certificate.h"
#include "audit/certificate/sha256.h"
#include "audit/thrown.h"
#include "fuzz/driver.h"
#include "motion/clip_file.h"
#include "motion/made_motions.h"
extern "C" {
#include "verify.h"
}

namespace mimicx::fuzz::certificates {

std::vector<std::string> seeds() {
  std::vector<std::string> found;
  const Scene box = {
      {{.half_extents = {0.3, 0.3}, .height = 0.2}, {.half_extents = {3.0, 3.0}, .height = 0.1}}};
  for (const Scene& scene : {Scene{}, box}) {
    audit::SubstepMotion motion = audit::Thrown(240.0, 0.08, scene).steps();
    motion.last = motion.steps[301].state;
    motion.steps = {motion.steps[300]};
    motion::Clip clip = test::standing_clip(2, 0.9);
    clip.scene = scene;
    const TemporaryFolder folder;
    motion::write_clip(folder.path / "m.npz", clip);
    const std::string npz = read_file(folder.path / "m.npz");
    const std::string certificate = audit::certificate_of(motion, {npz, 1});
    found.insert(found.end(), {certificate, certificate + npz});
  }
  return found;
}

void feed(const std::string& bytes) {
  std::string file = bytes, npz;
  const auto integer_at = [&](std::size_t at) {
    std::uint64_t value = 0;
    for (std::size_t i = 8; i-- > 0 && bytes.size() >= at + 8;)
      value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
    return value;
  };
  const std::uint64_t length = 5264 + 64 * integer_at(24) + 4400 * integer_at(16) + 1280 + 32;
  if (length >= 64 && length <= bytes.size()) {
    file = bytes.substr(0, length);
    npz = bytes.substr(length);
    file.replace(length - 32, 32, audit::sha256(std::string_view(file).substr(0, length - 32)));
  }
  std::array<Rule, RULES> rules{};
  const char* wrong = nullptr;
  const auto at = [](const std::string& s) { return reinterpret_cast<const unsigned char*>(s.data()); };
  verify_bytes(at(file), file.size(), npz.empty() ? nullptr : at(npz), npz.size(), rules.data(), &wrong);
}

const Target target("certificates", seeds, feed);

}  // namespace mimicx::fuzz::certificates
