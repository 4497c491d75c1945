# Writes OUTPUT, which defines the identity of the firmware: its VERSION, and as build id the first
# 8 hexadecimal digits of the SHA-256 of all files of the robot and of its extensions.
file(GLOB_RECURSE files RELATIVE ${SOURCE_DIR} ${SOURCE_DIR}/src/* ${SOURCE_DIR}/extensions/*)
list(SORT files)
set(digests "")
foreach(file IN LISTS files)
  file(SHA256 ${SOURCE_DIR}/${file} digest)
  string(APPEND digests "${file} ${digest}\n")
endforeach()
string(SHA256 digest "${digests}")
string(SUBSTRING ${digest} 0 8 build_id)
string(REGEX REPLACE "(.)" "'\\1', " characters ${build_id})
string(REGEX REPLACE ", $" "" characters ${characters})
string(REPLACE "." ", " version ${VERSION})
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
#include "communication/pc_connection/FirmwareIdentity.hpp"

namespace wr {

constinit const FirmwareIdentity firmwareIdentity{@version@, {@characters@}};

}  // namespace wr
]] @ONLY)
