# Cortex-M4F, bare metal.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m4)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_OBJCOPY arm-none-eabi-objcopy)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
# Neither exceptions nor unwinding: no tables for them. Static objects need no guard, for interrupts
# never make them. Paths are those in the project, so that the image is the same from any folder.
get_filename_component(project ${CMAKE_CURRENT_LIST_DIR} DIRECTORY)
string(CONCAT CMAKE_CXX_FLAGS_INIT
  "-mcpu=cortex-m4 -mthumb -mfloat-abi=hard -mfpu=fpv4-sp-d16 -Os -g "
  "-ffunction-sections -fdata-sections -fno-exceptions -fno-rtti -fno-threadsafe-statics "
  "-fno-unwind-tables -fno-asynchronous-unwind-tables -fno-use-cxa-atexit "
  "-ffile-prefix-map=${CMAKE_BINARY_DIR}=build/k64 -ffile-prefix-map=${project}=.")
