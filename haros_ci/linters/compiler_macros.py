# SPDX-License-Identifier: Apache-2.0
"""What GCC defines by itself for C++20 on x86-64 Linux: by these names code asks what there is, and cppcheck knows none of them.

(`g++ -dM -E -x c++ -std=gnu++20 -include version`; what stands for types, limits of floating point and what depends on optimization is left out.)
"""

from __future__ import annotations

#: Names that are there.
_PRESENT = """
_GNU_SOURCE __DECIMAL_BID_FORMAT__ __FXSR__ __GCC_ASM_FLAG_OUTPUTS__ __GCC_ATOMIC_TEST_AND_SET_TRUEVAL __GCC_HAVE_DWARF2_CFI_ASM
__GCC_HAVE_SYNC_COMPARE_AND_SWAP_1 __GCC_HAVE_SYNC_COMPARE_AND_SWAP_2 __GCC_HAVE_SYNC_COMPARE_AND_SWAP_4 __GCC_HAVE_SYNC_COMPARE_AND_SWAP_8
__GXX_EXPERIMENTAL_CXX0X__ __GXX_WEAK__ __MMX_WITH_SSE__ __MMX__ __SSE2_MATH__ __SSE2__ __SSE_MATH__ __SSE__ __STDCPP_THREADS__
__STDC_IEC_559_COMPLEX__ __STDC_IEC_559__ __STDC_UTF_16__ __STDC_UTF_32__ __STDC__ __amd64 __k8 __k8__
"""
#: Names with other values.
_VALUES = """
__BIGGEST_ALIGNMENT__=16 __DECIMAL_DIG__=21 __FINITE_MATH_ONLY__=0 __FLT_EVAL_METHOD__=0 __GCC_ATOMIC_BOOL_LOCK_FREE=2
__GCC_ATOMIC_CHAR16_T_LOCK_FREE=2 __GCC_ATOMIC_CHAR32_T_LOCK_FREE=2 __GCC_ATOMIC_CHAR8_T_LOCK_FREE=2 __GCC_ATOMIC_CHAR_LOCK_FREE=2
__GCC_ATOMIC_INT_LOCK_FREE=2 __GCC_ATOMIC_LLONG_LOCK_FREE=2 __GCC_ATOMIC_LONG_LOCK_FREE=2 __GCC_ATOMIC_POINTER_LOCK_FREE=2
__GCC_ATOMIC_SHORT_LOCK_FREE=2 __GCC_ATOMIC_WCHAR_T_LOCK_FREE=2 __GCC_IEC_559=2 __GCC_IEC_559_COMPLEX=2 __GLIBC_MINOR__=36 __GLIBC__=2
__GXX_ABI_VERSION=1017 __INT16_MAX__=0x7fff __INT32_MAX__=0x7fffffff __INT64_MAX__=0x7fffffffffffffffL __INT8_MAX__=0x7f
__INTMAX_MAX__=0x7fffffffffffffffL __INTMAX_WIDTH__=64 __INTPTR_MAX__=0x7fffffffffffffffL __INTPTR_WIDTH__=64
__INT_FAST16_MAX__=0x7fffffffffffffffL __INT_FAST16_WIDTH__=64 __INT_FAST32_MAX__=0x7fffffffffffffffL __INT_FAST32_WIDTH__=64
__INT_FAST64_MAX__=0x7fffffffffffffffL __INT_FAST64_WIDTH__=64 __INT_FAST8_MAX__=0x7f __INT_FAST8_WIDTH__=8 __INT_LEAST16_MAX__=0x7fff
__INT_LEAST16_WIDTH__=16 __INT_LEAST32_MAX__=0x7fffffff __INT_LEAST32_WIDTH__=32 __INT_LEAST64_MAX__=0x7fffffffffffffffL
__INT_LEAST64_WIDTH__=64 __INT_LEAST8_MAX__=0x7f __INT_LEAST8_WIDTH__=8 __LONG_LONG_MAX__=0x7fffffffffffffffLL __LONG_LONG_WIDTH__=64
__LONG_WIDTH__=64 __ORDER_PDP_ENDIAN__=3412 __PIC__=2 __PIE__=2 __PTRDIFF_MAX__=0x7fffffffffffffffL __PTRDIFF_WIDTH__=64 __SCHAR_WIDTH__=8
__SHRT_WIDTH__=16 __SIG_ATOMIC_MAX__=0x7fffffff __SIG_ATOMIC_WIDTH__=32 __SIZEOF_FLOAT128__=16 __SIZEOF_FLOAT80__=16 __SIZEOF_INT128__=16
__SIZEOF_LONG_DOUBLE__=16 __SIZEOF_PTRDIFF_T__=8 __SIZEOF_WCHAR_T__=4 __SIZEOF_WINT_T__=4 __SIZE_MAX__=0xffffffffffffffffUL
__SIZE_WIDTH__=64 __STDCPP_DEFAULT_NEW_ALIGNMENT__=16 __STDCPP_MATH_SPEC_FUNCS__=201003L __STDC_IEC_60559_BFP__=201404L
__STDC_IEC_60559_COMPLEX__=201404L __STDC_ISO_10646__=201706L __UINT16_MAX__=0xffff __UINT32_MAX__=0xffffffffU
__UINT64_MAX__=0xffffffffffffffffUL __UINT8_MAX__=0xff __UINTMAX_MAX__=0xffffffffffffffffUL __UINTPTR_MAX__=0xffffffffffffffffUL
__UINT_FAST16_MAX__=0xffffffffffffffffUL __UINT_FAST32_MAX__=0xffffffffffffffffUL __UINT_FAST64_MAX__=0xffffffffffffffffUL
__UINT_FAST8_MAX__=0xff __UINT_LEAST16_MAX__=0xffff __UINT_LEAST32_MAX__=0xffffffffU __UINT_LEAST64_MAX__=0xffffffffffffffffUL
__UINT_LEAST8_MAX__=0xff __WCHAR_MAX__=0x7fffffff __WCHAR_WIDTH__=32 __WINT_MAX__=0xffffffffU __WINT_MIN__=0U __WINT_WIDTH__=32 __pic__=2
__pie__=2
"""
#: Features of the language, ``__cpp_…``, by the month that tells their version (C++ standard, [cpp.predefined]).
_FEATURES = """
aggregate_bases=201603 aggregate_nsdmi=201304 aggregate_paren_init=201902 alias_templates=200704 aligned_new=201606 attributes=200809
binary_literals=201304 capture_star_this=201603 char8_t=201811 concepts=202002 conditional_explicit=201806 consteval=201811 constexpr=202002
constexpr_dynamic_alloc=201907 constexpr_in_decltype=201711 constinit=201907 decltype=200707 decltype_auto=201304 deduction_guides=201907
delegating_constructors=200604 designated_initializers=201707 digit_separators=201309 enumerator_attributes=201411 exceptions=199711
fold_expressions=201603 generic_lambdas=201707 guaranteed_copy_elision=201606 hex_float=201603 if_constexpr=201606 impl_coroutine=201902
impl_destroying_delete=201806 impl_three_way_comparison=201907 inheriting_constructors=201511 init_captures=201803 initializer_lists=200806
inline_variables=201606 lambdas=200907 namespace_attributes=201411 nested_namespace_definitions=201411 noexcept_function_type=201510
nontype_template_args=201911 nontype_template_parameter_auto=201606 nontype_template_parameter_class=201806 nsdmi=200809
range_based_for=201603 raw_strings=200710 ref_qualifiers=200710 return_type_deduction=201304 rtti=199711 runtime_arrays=198712
rvalue_reference=200610 rvalue_references=200610 sized_deallocation=201309 static_assert=201411 structured_bindings=201606
template_auto=201606 template_template_args=201611 threadsafe_static_init=200806 unicode_characters=201411 unicode_literals=200710
user_defined_literals=200809 using_enum=201907 variable_templates=201304 variadic_templates=200704 variadic_using=201611
"""
#: Features of the library, ``__cpp_lib_…`` ([version.syn]).
_LIBRARY = """
addressof_constexpr=201603 allocator_traits_is_always_equal=201411 any=201606 apply=201603 array_constexpr=201811 as_const=201510
assume_aligned=201811 atomic_flag_test=201907 atomic_float=201711 atomic_is_always_lock_free=201603 atomic_ref=201806
atomic_shared_ptr=201711 atomic_value_initialization=201911 atomic_wait=201907 barrier=201907 bind_front=201907 bit_cast=201806
bitops=201907 bool_constant=201505 bounded_array_traits=201902 boyer_moore_searcher=201603 byte=201603 char8_t=201907 chrono=201611
chrono_udls=201304 clamp=201603 complex_udls=201309 concepts=202002 constexpr_algorithms=201806 constexpr_char_traits=201811
constexpr_complex=201711 constexpr_dynamic_alloc=201907 constexpr_functional=201907 constexpr_iterator=201811 constexpr_memory=201811
constexpr_numeric=201911 constexpr_string=201907 constexpr_string_view=201811 constexpr_tuple=201811 constexpr_utility=201811
constexpr_vector=201907 coroutine=201902 destroying_delete=201806 enable_shared_from_this=201603 endian=201907 erase_if=202002
exchange_function=201304 execution=201902 filesystem=201703 gcd=201606 gcd_lcm=201606 generic_associative_lookup=201304
generic_unordered_lookup=201811 hardware_interference_size=201703 has_unique_object_representations=201606 hypot=201603
incomplete_container_elements=201505 int_pow2=202002 integer_comparison_functions=202002 integer_sequence=201304
integral_constant_callable=201304 interpolate=201902 invoke=201411 is_aggregate=201703 is_constant_evaluated=201811 is_final=201402
is_invocable=201703 is_layout_compatible=201907 is_nothrow_convertible=201806 is_null_pointer=201309 is_pointer_interconvertible=201907
is_swappable=201603 jthread=201911 latch=201907 launder=201606 lcm=201606 list_remove_return_type=201806 logical_traits=201510
make_from_tuple=201606 make_obj_using_allocator=201811 make_reverse_iterator=201402 make_unique=201304 map_try_emplace=201411
math_constants=201907 math_special_functions=201603 memory_resource=201603 node_extract=201606 nonmember_container_access=201411
not_fn=201603 null_iterators=201304 optional=202106 parallel_algorithm=201603 polymorphic_allocator=201902 quoted_string_io=201304
ranges=202110 raw_memory_algorithms=201606 remove_cvref=201711 result_of_sfinae=201210 robust_nonmodifying_seq_ops=201304 sample=201603
scoped_lock=201703 semaphore=201907 shared_mutex=201505 shared_ptr_arrays=201707 shared_ptr_weak_type=201606 shared_timed_mutex=201402
shift=201806 smart_ptr_for_overwrite=202002 source_location=201907 span=202002 ssize=201902 starts_ends_with=201711 string_udls=201304
string_view=201803 syncbuf=201803 three_way_comparison=201907 to_address=201711 to_array=201907 to_chars=201611
transformation_trait_aliases=201304 transparent_operators=201510 tuple_element_t=201402 tuples_by_type=201304 type_identity=201806
type_trait_variable_templates=201510 uncaught_exceptions=201411 unordered_map_try_emplace=201411 unwrap_ref=201811 variant=202106
void_t=201411
"""


def predefined() -> dict[str, str]:
    """Each name, and what it stands for."""
    return {
        **dict.fromkeys(_PRESENT.split(), "1"),
        **dict(_pairs(_VALUES)),
        **{f"__cpp_{name}": f"{value}L" for name, value in _pairs(_FEATURES)},
        **{f"__cpp_lib_{name}": f"{value}L" for name, value in _pairs(_LIBRARY)},
    }


def _pairs(text: str) -> list[tuple[str, str]]:
    return [(name, value) for name, _, value in (word.partition("=") for word in text.split())]
