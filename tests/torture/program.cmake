# The torture program. It is built for the processor of the K64.
set(torture_program ${CMAKE_BINARY_DIR}/torture/torture.bin)
set(torture_folder ${CMAKE_CURRENT_SOURCE_DIR}/torture)
set(torture_sources
  ${torture_folder}/program/start.S
  ${torture_folder}/program/probe.S
  ${torture_folder}/program/Log.cpp
  ${torture_folder}/program/torture.cpp)
file(GLOB torture_headers CONFIGURE_DEPENDS
  ${torture_folder}/*.hpp ${torture_folder}/program/*.hpp)
find_program(torture_compiler arm-none-eabi-g++ REQUIRED)
find_program(torture_objcopy arm-none-eabi-objcopy REQUIRED)

# Only probe.S touches the floating-point registers. The program is loaded at address 0.
set(torture_options
  -std=c++20 -mcpu=cortex-m4 -mthumb -mfloat-abi=softfp -mgeneral-regs-only -O2 -g
  -ffreestanding -fno-exceptions -fno-rtti --param=min-pagesize=0
  -Wall -Wextra -Wconversion -Werror -I ${CMAKE_CURRENT_SOURCE_DIR})
add_custom_command(OUTPUT ${torture_program}
  COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/torture
  COMMAND ${torture_compiler} ${torture_options} -nostdlib -nostartfiles
    -T ${torture_folder}/program/program.ld ${torture_sources} -lgcc
    -o ${CMAKE_BINARY_DIR}/torture/torture.elf
  COMMAND ${torture_objcopy} -O binary ${CMAKE_BINARY_DIR}/torture/torture.elf ${torture_program}
  DEPENDS ${torture_sources} ${torture_headers} ${torture_folder}/program/program.ld
  COMMENT "Torture program"
  VERBATIM)
add_custom_target(torture_program DEPENDS ${torture_program})
