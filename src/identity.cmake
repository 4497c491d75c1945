# Writes the C++ file OUTPUT, which defines the identity of the firmware: the version VERSION, the build id, and the
# schema hash. The build id is the first 8 hexadecimal digits of the SHA-256 of a list: each line of the list contains
# the name and the SHA-256 of one file in src or extensions. The interpreter PYTHON computes the schema hash from
# design/frames.toml.
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
execute_process(
  COMMAND ${PYTHON} ${SOURCE_DIR}/client/weeding_robot_client/layout.py
  OUTPUT_VARIABLE schema_hash OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT [[
#include "communication/pc_connection/FirmwareIdentity.hpp"

namespace wr {

constinit const FirmwareIdentity firmwareIdentity{@version@, {@characters@}, @schema_hash@};

}  // namespace wr
]] @ONLY)
