# The program with which the tests use each driver separately. It is built for the K64. It contains the drivers and the
# start-up code of the firmware, but not the robot.
set(drivers_program ${CMAKE_BINARY_DIR}/drivers/drivers.bin)
file(GLOB drivers_sources CONFIGURE_DEPENDS
  ${CMAKE_SOURCE_DIR}/src/k64/*.cpp ${CMAKE_SOURCE_DIR}/src/k64/start_up/*.cpp)
list(FILTER drivers_sources EXCLUDE REGEX "/start_up/(main.*|control_systems|pool)[.]cpp$")
list(APPEND drivers_sources
  ${CMAKE_SOURCE_DIR}/src/services/ControlThread.cpp
  ${CMAKE_CURRENT_SOURCE_DIR}/k64/program/drivers.cpp)
file(GLOB_RECURSE drivers_headers CONFIGURE_DEPENDS
  ${CMAKE_SOURCE_DIR}/src/k64/*.hpp ${CMAKE_SOURCE_DIR}/src/devices/*.hpp
  ${CMAKE_SOURCE_DIR}/src/services/*.hpp ${CMAKE_SOURCE_DIR}/src/units/*.hpp)
set(drivers_script ${CMAKE_SOURCE_DIR}/src/k64/start_up/k64.ld)
find_program(drivers_compiler arm-none-eabi-g++ REQUIRED)
find_program(drivers_objcopy arm-none-eabi-objcopy REQUIRED)

add_custom_command(OUTPUT ${drivers_program}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/drivers
  COMMAND ${drivers_compiler} -std=c++20 -mcpu=cortex-m4 -mthumb -mfloat-abi=hard
    -mfpu=fpv4-sp-d16 -Os -g -ffunction-sections -fdata-sections -fno-threadsafe-statics
    -fno-unwind-tables -fno-asynchronous-unwind-tables -fno-exceptions -fno-rtti -Wall -Wextra
    -Wconversion -Werror -I ${CMAKE_SOURCE_DIR}/src -nostdlib -T ${drivers_script}
    -fno-tree-loop-distribute-patterns -save-temps=obj
    -Wl,--gc-sections -Wl,--fatal-warnings ${drivers_sources} -lc -lgcc
    -o ${CMAKE_BINARY_DIR}/drivers/drivers.elf
  COMMAND ${drivers_objcopy} -O binary ${CMAKE_BINARY_DIR}/drivers/drivers.elf ${drivers_program}
  DEPENDS ${drivers_sources} ${drivers_headers} ${drivers_script}
  COMMENT "Program that uses the drivers"
  VERBATIM)
add_custom_target(drivers_program DEPENDS ${drivers_program})
