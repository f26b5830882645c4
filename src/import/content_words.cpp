#include "import/content_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "import/text_input.h"

namespace mimicx::import {
namespace {

struct Opening {
  std::string_view bytes;  ///< in lower case
  const char* words;
};
constexpr std::array kOpenings = {
    Opening{"kaydara fbx", "an FBX file (export it as BVH, e.g. from Blender)"},
    Opening{"; fbx", "an FBX file (export it as BVH, e.g. from Blender)"},
    Opening{"\x1f\x8b", "a gzip archive (unpack it first)"},
    Opening{"bzh", "a bzip2 archive (unpack it first)"},
    Opening{"\xfd\x37zxz", "an xz archive (unpack it first)"},
    Opening{"7z\xbc\xaf", "a 7z archive (unpack it first)"},
    Opening{"rar!", "a rar archive (unpack it first)"},
    Opening{"<!doctype html", "a web page (the download gave a page in place of the file)"},
    Opening{"<html", "a web page (the download gave a page in place of the file)"},
    Opening{"<?xml", "an XML file"},
    Opening{"version https://git-lfs", "a Git LFS pointer (the file itself comes with: git lfs pull)"},
    Opening{"gltf", "a glTF file (export it as BVH, e.g. from Blender)"},
    Opening{"vocaloid motion data", "an MMD motion, VMD (export it as BVH, e.g. from Blender)"},
    Opening{"pxr-usdc", "a USD file (export it as BVH)"},
    Opening{"#usda", "a USD file (export it as BVH)"},
    Opening{"\x89hdf", "an HDF5 file (save its arrays as .npz)"},
    Opening{"matlab 5.0 mat-file", "a MATLAB file (save its arrays as .npz, e.g. with scipy.io.loadmat)"},
    Opening{":version", "an ASF skeleton (convert it and its AMC motion to BVH)"},
    Opening{"# ast/asf", "an ASF skeleton (convert it and its AMC motion to BVH)"},
    Opening{"#!oml:asf", "an AMC motion (convert it and its ASF skeleton to BVH)"},
    Opening{"[", "a JSON list"},
};

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(), [](unsigned char c) { return std::tolower(c); });
  return out;
}

}  // namespace

std::string content_in_words(const std::string& bytes) {
  if (bytes.empty()) return "an empty file";
  const std::string_view start = std::string_view(bytes).substr(0, 256);
  const bool utf16 = start.starts_with("\xff\xfe") || start.starts_with("\xfe\xff") ||
                     (start.size() > 3 && (start.substr(1, 3) == std::string_view("\0I\0", 3) ||
                                           start.substr(0, 4) == std::string_view("\0H\0I", 4)));
  if (utf16) return "UTF-16 text (save it as UTF-8)";
  if (start.size() > 1 && start[0] < 10 && start[1] == 'P') return "a C3D file (it has markers, no skeleton)";
  const std::size_t bom = start.starts_with("\xef\xbb\xbf") ? 3 : 0;
  const std::size_t first = std::min(start.find_first_not_of(" \t\r\n", bom), start.size());
  const std::string opening = lower(start.substr(first));
  for (const auto& [begins, words] : kOpenings)
    if (opening.starts_with(begins)) return words;
  if (first == start.size()) return "nothing but blanks at its beginning";
  const std::size_t end = std::min(bytes.find_first_of("\r\n", first), bytes.size());
  return "other content, line 1 begins with '" +
         printable(std::string_view(bytes).substr(first, end - first)) + "'";
}

}  // namespace mimicx::import
