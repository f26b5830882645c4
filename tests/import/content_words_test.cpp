#include "import/content_words.h"

#include <gtest/gtest.h>

namespace mimicx::import {
namespace {

using std::string_literals::operator""s;

TEST(ContentWords, NameWhatIsNoMotionAndWhatToDo) {
  for (const auto& [bytes, word] : {std::pair{"\xff\xfeH\0I\0"s, "UTF-16"},
                                    {"H\0I\0E\0R\0"s, "UTF-16"},
                                    {"\0H\0I\0E"s, "UTF-16"},
                                    {"Kaydara FBX Binary  \0"s, "FBX"},
                                    {"; FBX 7.4.0 project file"s, "FBX"},
                                    {"\x1f\x8b\x08"s, "gzip"},
                                    {"<!DOCTYPE html><html>"s, "web page"},
                                    {" \n<html>"s, "web page"},
                                    {"version https://git-lfs.github.com/spec/v1"s, "git lfs pull"},
                                    {"\x02P\0\0"s, "C3D"},
                                    {":version 1.10"s, "ASF"},
                                    {"[1, 2]"s, "JSON list"},
                                    {""s, "empty"},
                                    {"once upon\na time"s, "'once upon'"}})
    EXPECT_NE(content_in_words(bytes).find(word), std::string::npos) << content_in_words(bytes);
}

}  // namespace
}  // namespace mimicx::import
