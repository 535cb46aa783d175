# Writes OUTPUT: the hash of IDL_FILES and the text of every one of MSG_FILES, as C++.
# Comments and white space do not count in the hash: they do not change what is on the wire.
set(all "")
foreach(file IN LISTS IDL_FILES)
  file(READ ${file} text)
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "[ \t\r\n]+" " " text "${text}")
  string(APPEND all "${text}\n")
endforeach()
string(SHA256 hash "${all}")
string(SUBSTRING ${hash} 0 16 hash)

set(entries "")
foreach(file IN LISTS MSG_FILES)
  get_filename_component(type ${file} NAME_WE)
  get_filename_component(folder ${file} DIRECTORY)
  get_filename_component(package ${folder} NAME)
  file(READ ${file} text)
  string(APPEND entries "    {\"${package}/msg/${type}\", R\"msg(${text})msg\"},\n")
endforeach()

file(WRITE ${OUTPUT} "// Generated from idl/ by cmake/embed_idl.cmake.
#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace vpdr::dds {

std::string_view idl_hash_text() { return \"${hash}\"; }

std::span<const std::pair<std::string_view, std::string_view>> msg_texts() {
  static constexpr auto kTexts = std::to_array<std::pair<std::string_view, std::string_view>>({
${entries}  });
  return kTexts;
}

}  // namespace vpdr::dds
")
