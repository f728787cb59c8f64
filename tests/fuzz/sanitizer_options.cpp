/// Options of the address sanitizer for this program: what is too large is refused as it is without the sanitizer, and
/// memory that was given back is kept aside only a little, so that the peak means something.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() {
  return "allocator_may_return_null=1:quarantine_size_mb=8:detect_leaks=0";
}
