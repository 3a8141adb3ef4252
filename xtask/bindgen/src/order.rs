//! The functions of a module in the order in which they compress best: those alike stand one after the other. By type,
//! size and bytes it is 2 % less than by size alone, which is how walrus writes them.

use std::cmp::Reverse;
use std::convert::Infallible;

use wasm_encoder::reencode::{Error, Reencode, utils};
use wasm_encoder::{CodeSection, FunctionSection, Module};
use wasmparser::{
    CodeSectionReader, FunctionBody, FunctionSectionReader, Parser, Payload, TypeRef,
};

/// Writes a module with its own functions in another order. What names them by index names the same ones then.
///
/// # Errors
/// Bytes that are no module.
pub(crate) fn ordered(bytes: &[u8]) -> Result<Vec<u8>, String> {
    let told = |error: &dyn std::fmt::Display| error.to_string();
    let mut order = Order::of(bytes).map_err(|error| told(&error))?;
    let mut module = Module::new();
    order.parse_core_module(&mut module, Parser::new(0), bytes).map_err(|error| told(&error))?;
    Ok(module.finish())
}

/// Which place each of a module's functions has.
struct Order {
    imported: u32,
    /// The functions' places before, in the new order.
    before: Vec<u32>,
    /// Their new places, in the order before.
    after: Vec<u32>,
}

impl Order {
    fn of(bytes: &[u8]) -> wasmparser::Result<Order> {
        let (mut imported, mut types, mut bodies) = (0, Vec::new(), Vec::new());
        for payload in Parser::new(0).parse_all(bytes) {
            match payload? {
                Payload::ImportSection(imports) => {
                    for import in imports.into_imports() {
                        imported += u32::from(matches!(import?.ty, TypeRef::Func(_)));
                    }
                }
                Payload::FunctionSection(functions) => {
                    types = functions.into_iter().collect::<wasmparser::Result<Vec<u32>>>()?;
                }
                Payload::CodeSectionEntry(body) => bodies.push(&bytes[body.range()]),
                _ => {}
            }
        }
        let mut before: Vec<u32> = (0..).take(bodies.len()).collect();
        before.sort_by_key(|&at| {
            let body = bodies[at as usize];
            (types.get(at as usize), Reverse(body.len().ilog2()), body)
        });
        let mut after = vec![0; before.len()];
        for (new, &old) in (0..).zip(&before) {
            after[old as usize] = new;
        }
        Ok(Order { imported, before, after })
    }
}

impl Reencode for Order {
    type Error = Infallible;

    fn function_index(&mut self, function: u32) -> Result<u32, Error<Infallible>> {
        let own = function.checked_sub(self.imported).and_then(|own| self.after.get(own as usize));
        Ok(own.map_or(function, |own| self.imported + own))
    }

    fn parse_function_section(
        &mut self,
        functions: &mut FunctionSection,
        section: FunctionSectionReader<'_>,
    ) -> Result<(), Error<Infallible>> {
        let types = section.into_iter().collect::<wasmparser::Result<Vec<u32>>>()?;
        for &old in &self.before {
            functions.function(types[old as usize]);
        }
        Ok(())
    }

    fn parse_code_section(
        &mut self,
        code: &mut CodeSection,
        section: CodeSectionReader<'_>,
    ) -> Result<(), Error<Infallible>> {
        let bodies = section.into_iter().collect::<wasmparser::Result<Vec<FunctionBody<'_>>>>()?;
        for old in self.before.clone() {
            utils::parse_function_body(self, code, bodies[old as usize].clone())?;
        }
        Ok(())
    }
}
