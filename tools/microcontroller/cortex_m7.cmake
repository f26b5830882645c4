# Toolchain: Debian's gcc-arm-none-eabi for a Cortex-M7 with a double-precision floating-point unit, no operating
# system.
#   cmake --preset bare -B build/cortex-m7 --toolchain tools/microcontroller/cortex_m7.cmake
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m7)
set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_AR arm-none-eabi-gcc-ar)
set(CMAKE_RANLIB arm-none-eabi-gcc-ranlib)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # programs need a linker script
set(CMAKE_CXX_FLAGS_INIT "-mcpu=cortex-m7 -mthumb -mfloat-abi=hard -mfpu=fpv5-d16 -ffunction-sections -fdata-sections \
-fno-threadsafe-statics -fno-unwind-tables -fno-asynchronous-unwind-tables")
