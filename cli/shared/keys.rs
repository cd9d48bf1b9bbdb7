//! JSON in one way: structs whose fields are the keys, each beside where its value comes from.

/// Declares structs of keys with their `new`: `Name(from: Type) { key: Type = value, }`.
macro_rules! keys {
    ($(
        $(#[$about:meta])*
        $name:ident$(<$a:lifetime>)?($($from:ident: $of:ty),+) {
            $($(#[$how:meta])* $key:ident: $type:ty = $value:expr,)+
        }
    )+) => {$(
        $(#[$about])*
        #[derive(serde::Serialize)]
        #[allow(clippy::struct_field_names, reason = "keys say their unit")]
        pub(crate) struct $name$(<$a>)? {
            $($(#[$how])* pub(crate) $key: $type,)+
        }

        impl$(<$a>)? $name$(<$a>)? {
            pub(crate) fn new($($from: $of),+) -> Self {
                Self { $($key: $value,)+ }
            }
        }
    )+};
}

pub(crate) use keys;
