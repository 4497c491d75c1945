# The programs that the tests of the virtual K64 run. They are built for the processor of the K64.
set(guest_program ${CMAKE_BINARY_DIR}/guest/guest.bin)
set(guest_folder ${CMAKE_CURRENT_SOURCE_DIR}/sim/emulator/guest)
file(GLOB guest_sources CONFIGURE_DEPENDS ${guest_folder}/*.cpp)
file(GLOB guest_headers CONFIGURE_DEPENDS ${guest_folder}/*.hpp)
find_program(guest_compiler arm-none-eabi-g++ REQUIRED)
find_program(guest_objcopy arm-none-eabi-objcopy REQUIRED)

add_custom_command(OUTPUT ${guest_program}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/guest
  COMMAND ${guest_compiler} -std=c++20 -mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16
    -O1 -g -ffreestanding -fno-exceptions -fno-rtti --param=min-pagesize=0
    -Wall -Wextra -Wconversion -Werror -nostdlib -nostartfiles -Wl,-Ttext=0x410 -Wl,-e,0
    -Wl,--build-id=none ${guest_sources} -o ${CMAKE_BINARY_DIR}/guest/guest.elf
  COMMAND ${guest_objcopy} -O binary -j .text ${CMAKE_BINARY_DIR}/guest/guest.elf ${guest_program}
  DEPENDS ${guest_sources} ${guest_headers}
  COMMENT "Programs for the tests of the virtual K64"
  VERBATIM)
add_custom_target(guest_program DEPENDS ${guest_program})
