# Builds a raw program file without symbols for the virtual K64. The program is not part of the firmware.
set(alone_program ${CMAKE_BINARY_DIR}/guest/alone.bin)
set(alone_folder ${CMAKE_CURRENT_SOURCE_DIR}/sim/emulator/alone)
find_program(alone_compiler arm-none-eabi-gcc REQUIRED)

add_custom_command(OUTPUT ${alone_program}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/guest
  COMMAND ${alone_compiler} -std=c11 -mcpu=cortex-m4 -mthumb -Os -ffreestanding -Wall -Wextra
    -Werror -nostdlib -nostartfiles -Wl,--build-id=none -T ${alone_folder}/alone.ld
    ${alone_folder}/alone.c -o ${CMAKE_BINARY_DIR}/guest/alone.elf
  COMMAND ${guest_objcopy} -O binary ${CMAKE_BINARY_DIR}/guest/alone.elf ${alone_program}
  DEPENDS ${alone_folder}/alone.c ${alone_folder}/alone.ld
  COMMENT "Program without symbols for the virtual K64"
  VERBATIM)
add_custom_target(alone_program DEPENDS ${alone_program})
