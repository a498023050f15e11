//! Structs of numbers, field by field.

/// Common operations of structs of numbers and arrays of numbers: all of them zero, and one after another.
macro_rules! of_numbers {
    ($name:ident: $($single:ident)*; $($array:ident)*) => {
        #[doc(hidden)]
        impl<S: crate::scalar::Number> $name<S> {
            /// Zero, with the lanes of a number.
            #[inline(always)]
            pub fn none(like: S) -> Self {
                let zero = like.constant(0.0);
                Self { $($single: zero,)* $($array: crate::scalar::array(|_| zero),)* }
            }

            /// All its numbers.
            #[inline(always)]
            pub fn numbers(&mut self) -> impl Iterator<Item = &mut S> {
                [$(&mut self.$single),*].into_iter()$(.chain(&mut self.$array))*
            }
        }
    };
}

pub(super) use of_numbers;
