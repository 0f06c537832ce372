// SPDX-License-Identifier: MIT
// Under the address sanitizer, leaks of the graphics driver and of the validation layer are ignored. The
// sanitizer recognises these leaks by their library, so libraries must still be loaded when it looks for
// leaks.
#if defined(__SANITIZE_ADDRESS__)

extern "C" {

// Keeps every library loaded until the program ends, by replacing the C library's function.
int dlclose(void* /*library*/);
const char* __lsan_default_suppressions();

int dlclose(void* /*library*/)
{
    return 0;
}

const char* __lsan_default_suppressions()
{
    return "leak:libvulkan_lvp\nleak:libVkLayer_khronos_validation\nleak:libLLVM\nleak:libvulkan.so\n";
}

} // extern "C"

#endif
