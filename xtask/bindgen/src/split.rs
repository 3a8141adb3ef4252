//! A module in two: the code that a page needs at first, and the rest, which comes while the page is in use already.
//!
//! Each function of the rest has a gate in the first module: it has the rest fetched where it is not there yet, and
//! goes through a table that the rest fills. The rest is given the first module's exports, and shares its memory.

use std::collections::{BTreeSet, HashMap};

use walrus::ir::{Visitor, dfs_in_order};
use walrus::{
    ConstExpr, ElementId, ElementItems, ElementKind, ExportItem, FunctionBuilder, FunctionId,
    FunctionKind, GlobalKind, ImportKind, ImportedFunction, LocalFunction, Module, ModuleConfig,
    RefType, TableId, ValType, ir,
};

/// The import that the rest is fetched by.
const NEED: &str = "needRest";
/// What the first module exports besides: the table of the rest's functions, and whether they are there.
const TABLE: &str = "rest";
const THERE: &str = "there";
/// What the rest calls the module that it imports from.
const FIRST: &str = "first";

/// The two modules.
pub(crate) struct Split {
    pub(crate) first: Vec<u8>,
    pub(crate) rest: Vec<u8>,
}

/// Splits a module; its functions must have names. What `is_later` names goes into the rest.
///
/// # Errors
/// A sentence about what the module lacks.
pub(crate) fn split(wasm: &[u8], is_later: &dyn Fn(&str) -> bool) -> Result<Split, String> {
    let read = || read(wasm);
    // functions are told by where they stand: both are read from the same bytes
    let (mut first, mut rest) = (read()?, read()?);
    let order = |module: &Module| module.funcs.iter().map(walrus::Function::id).collect();
    let (in_first, in_rest): (Vec<FunctionId>, Vec<FunctionId>) = (order(&first), order(&rest));
    let places: HashMap<FunctionId, usize> =
        in_first.iter().enumerate().map(|(at, id)| (*id, at)).collect();
    let listed: Vec<bool> = first.funcs.iter().map(|f| is_listed(f, is_later)).collect();
    let later = later(&first, &listed, &places);
    let need = first.imports.iter().find_map(|import| match import.kind {
        ImportKind::Function(id) if import.name == NEED => Some(id),
        _ => None,
    });
    let need = need.ok_or("the module imports nothing that the rest is fetched by")?;

    let entered: Vec<usize> = entered(&first, &later, &places).into_iter().collect();
    shut_gates(&mut first, &in_first, &entered, need);
    open_gates(&mut rest, &in_rest, &entered);
    let shared = share(&mut first, &mut rest, (&in_first, &in_rest), &later);
    walrus::passes::gc::run(&mut rest);
    // what the rest does not use need not be told to it
    let used: BTreeSet<&str> = rest.imports.iter().map(|import| import.name.as_str()).collect();
    for (name, item) in shared {
        if used.contains(name.as_str()) {
            first.exports.add(&name, item);
        }
    }
    walrus::passes::gc::run(&mut first);
    Ok(Split { first: first.emit_wasm(), rest: rest.emit_wasm() })
}

/// Reads a module, to be written without its names.
fn read(wasm: &[u8]) -> Result<Module, String> {
    let mut config = ModuleConfig::new();
    config.generate_name_section(false);
    config.generate_producers_section(false);
    config.parse(wasm).map_err(|error| format!("{error:#}"))
}

fn is_listed(function: &walrus::Function, is_later: &dyn Fn(&str) -> bool) -> bool {
    let is_local = matches!(function.kind, FunctionKind::Local(_));
    is_local && function.name.as_deref().is_some_and(is_later)
}

/// Calls back with each function that another one names.
fn named_by(function: &LocalFunction, found: &mut dyn FnMut(FunctionId)) {
    struct Named<'a>(&'a mut dyn FnMut(FunctionId));
    impl<'i> Visitor<'i> for Named<'_> {
        fn visit_function_id(&mut self, function: &FunctionId) {
            (self.0)(*function);
        }
    }
    dfs_in_order(&mut Named(found), function, function.entry_block());
}

/// Calls back with each function that a module's tables and exports name.
fn named_outside(module: &Module, found: &mut dyn FnMut(FunctionId)) {
    for export in module.exports.iter() {
        if let ExportItem::Function(id) = export.item {
            found(id);
        }
    }
    for element in module.elements.iter() {
        match &element.items {
            ElementItems::Functions(all) => all.iter().copied().for_each(&mut *found),
            ElementItems::Expressions(_, all) => {
                for item in all {
                    if let ConstExpr::RefFunc(id) = item {
                        found(*id);
                    }
                }
            }
        }
    }
    module.start.into_iter().for_each(found);
}

/// Tells of each function whether it goes into the rest: what is listed, and what nothing else calls.
fn later(module: &Module, listed: &[bool], places: &HashMap<FunctionId, usize>) -> Vec<bool> {
    let mut later = vec![true; listed.len()];
    let mut open: Vec<FunctionId> = Vec::new();
    named_outside(module, &mut |id| open.push(id));
    while let Some(id) = open.pop() {
        let at = places[&id];
        if listed[at] || !std::mem::replace(&mut later[at], false) {
            continue;
        }
        if let FunctionKind::Local(function) = &module.funcs.get(id).kind {
            named_by(function, &mut |id| open.push(id));
        }
    }
    for (at, function) in module.funcs.iter().enumerate() {
        later[at] &= matches!(function.kind, FunctionKind::Local(_));
    }
    later
}

/// Finds the functions of the rest that something of the first module names, by their places.
fn entered(
    module: &Module,
    later: &[bool],
    places: &HashMap<FunctionId, usize>,
) -> BTreeSet<usize> {
    let mut found = BTreeSet::new();
    let mut name = |id: FunctionId| {
        let at = places[&id];
        if later[at] {
            found.insert(at);
        }
    };
    for (id, function) in module.funcs.iter_local() {
        if !later[places[&id]] {
            named_by(function, &mut name);
        }
    }
    named_outside(module, &mut name);
    found
}

/// Puts a gate in the place of each function of the rest that the first module names.
fn shut_gates(first: &mut Module, all: &[FunctionId], entered: &[usize], need: FunctionId) {
    let count = entered.len() as u64;
    let table = first.tables.add_local(false, count, Some(count), RefType::FUNCREF);
    let there = ConstExpr::Value(ir::Value::I32(0));
    let there = first.globals.add_local(ValType::I32, true, false, there);
    first.exports.add(TABLE, table);
    first.exports.add(THERE, there);
    for (slot, at) in (0..).zip(entered) {
        let ty = first.funcs.get(all[*at]).ty();
        let gate = gate(first, ty, (slot, table), there, need);
        first.funcs.get_mut(all[*at]).kind = FunctionKind::Local(gate);
    }
}

/// Makes a function that asks for the rest where it is not there, and hands on what it is called with.
fn gate(
    module: &mut Module,
    ty: walrus::TypeId,
    (slot, table): (i32, TableId),
    there: walrus::GlobalId,
    need: FunctionId,
) -> LocalFunction {
    let (takes, gives) = (module.types.params(ty).to_vec(), module.types.results(ty).to_vec());
    let given: Vec<_> = takes.iter().map(|ty| module.locals.add(*ty)).collect();
    let mut builder = FunctionBuilder::new(&mut module.types, &takes, &gives);
    let mut body = builder.func_body();
    body.global_get(there).unop(ir::UnaryOp::I32Eqz).if_else(
        None,
        |then| {
            then.call(need);
        },
        |_| {},
    );
    for local in &given {
        body.local_get(*local);
    }
    body.i32_const(slot).call_indirect(ty, table);
    builder.local_func(given)
}

/// Fills the table with the functions that the gates lead to.
fn open_gates(rest: &mut Module, all: &[FunctionId], entered: &[usize]) {
    rest.exports.iter().map(walrus::Export::id).collect::<Vec<_>>().into_iter().for_each(|id| {
        rest.exports.delete(id);
    });
    let elements: Vec<ElementId> = rest.elements.iter().map(walrus::Element::id).collect();
    for id in elements {
        rest.elements.delete(id);
    }
    for table in rest.tables.iter_mut() {
        table.elem_segments.clear();
    }
    let data: Vec<_> = rest.data.iter().map(walrus::Data::id).collect();
    for id in data {
        rest.data.delete(id);
    }
    for memory in rest.memories.iter_mut() {
        memory.data_segments.clear();
    }
    rest.start = None;
    let count = entered.len() as u64;
    let (table, _) =
        rest.add_import_table(FIRST, TABLE, false, count, Some(count), RefType::FUNCREF);
    let offset = ConstExpr::Value(ir::Value::I32(0));
    let functions = entered.iter().map(|at| all[*at]).collect();
    let kind = ElementKind::Active { table, offset };
    let filled = rest.elements.add(kind, ElementItems::Functions(functions));
    rest.tables.get_mut(table).elem_segments.insert(filled);
}

/// Has the rest import all that it does not define itself; returns what the first module may have to export for it,
/// by name.
fn share(
    first: &mut Module,
    rest: &mut Module,
    (in_first, in_rest): (&[FunctionId], &[FunctionId]),
    later: &[bool],
) -> Vec<(String, ExportItem)> {
    let mut shared: Vec<(String, ExportItem)> = Vec::new();
    // no name that Rust gives begins with a digit
    let mut named = |item: ExportItem| {
        let name = short(shared.len());
        shared.push((name.clone(), item));
        name
    };
    let imports: Vec<_> =
        rest.imports.iter().filter(|i| i.module != FIRST).map(walrus::Import::id).collect();
    for id in imports {
        rest.imports.delete(id);
    }
    for ((first_id, rest_id), _) in
        in_first.iter().zip(in_rest).zip(later).filter(|(_, later)| !**later)
    {
        let name = named(ExportItem::Function(*first_id));
        let import = rest.imports.add(FIRST, &name, *rest_id);
        let function = rest.funcs.get_mut(*rest_id);
        function.kind = FunctionKind::Import(ImportedFunction { import, ty: function.ty() });
    }
    let tables: Vec<_> = first.tables.iter().map(walrus::Table::id).collect();
    let own: Vec<_> =
        rest.tables.iter().filter(|t| t.import.is_none()).map(walrus::Table::id).collect();
    for (theirs, own) in tables.into_iter().zip(own) {
        let import = rest.imports.add(FIRST, &named(ExportItem::Table(theirs)), own);
        rest.tables.get_mut(own).import = Some(import);
    }
    let memories: Vec<_> = first.memories.iter().map(walrus::Memory::id).collect();
    let own: Vec<_> = rest.memories.iter().map(walrus::Memory::id).collect();
    for (theirs, own) in memories.into_iter().zip(own) {
        let import = rest.imports.add(FIRST, &named(ExportItem::Memory(theirs)), own);
        rest.memories.get_mut(own).import = Some(import);
    }
    let globals: Vec<_> = first.globals.iter().map(walrus::Global::id).collect();
    let own: Vec<_> = rest.globals.iter().map(walrus::Global::id).collect();
    for (theirs, own) in globals.into_iter().zip(own) {
        let import = rest.imports.add(FIRST, &named(ExportItem::Global(theirs)), own);
        rest.globals.get_mut(own).kind = GlobalKind::Import(import);
    }
    shared
}

/// Returns the shortest name of a number that begins with a digit.
fn short(mut number: usize) -> String {
    let digits = b"0123456789abcdefghijklmnopqrstuvwxyz";
    let mut name = String::from(char::from(digits[number % 10]));
    number /= 10;
    while number > 0 {
        name.push(char::from(digits[number % 36]));
        number /= 36;
    }
    name
}

/// Gives each function an exported counter `counted N`, and returns the functions' sizes, in instructions, and names in
/// order: for finding out which of them a page needs at first.
pub(crate) fn counted(wasm: &[u8]) -> Result<(Vec<u8>, String), String> {
    let mut module = read(wasm)?;
    let all: Vec<FunctionId> = module.funcs.iter_local().map(|(id, _)| id).collect();
    let mut names = String::new();
    for (number, id) in all.into_iter().enumerate() {
        let none = ConstExpr::Value(ir::Value::I32(0));
        let counter = module.globals.add_local(ValType::I32, true, false, none);
        module.exports.add(&format!("counted {number}"), counter);
        let function = module.funcs.get_mut(id);
        let size = function.kind.unwrap_local().size();
        names += &format!("{size} {}\n", function.name.as_deref().unwrap_or_default());
        let mut body = function.kind.unwrap_local_mut().builder_mut().func_body();
        body.global_set_at(0, counter).const_at(0, ir::Value::I32(1));
    }
    Ok((module.emit_wasm(), names))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A module that exports `page::start`, which calls `page::helper` and `later::begin`; that calls `core::twice` and
    /// `page::helper`.
    fn module() -> Vec<u8> {
        let mut module = Module::with_config(ModuleConfig::new());
        let ty = module.types.add(&[ValType::I32], &[ValType::I32]);
        let nothing = module.types.add(&[], &[]);
        module.add_import_func("./page.js", NEED, nothing);
        let mut add = |name: &str, calls: &[FunctionId]| {
            let mut builder =
                FunctionBuilder::new(&mut module.types, &[ValType::I32], &[ValType::I32]);
            let given = module.locals.add(ValType::I32);
            let mut body = builder.name(name.into()).func_body();
            body.local_get(given);
            for function in calls {
                body.call(*function);
            }
            builder.finish(vec![given], &mut module.funcs)
        };
        let helper = add("page::helper", &[]);
        let twice = add("core::twice", &[]);
        let begin = add("later::begin", &[twice, helper]);
        let start = add("page::start", &[helper, begin]);
        assert_eq!(module.funcs.get(start).ty(), ty);
        module.exports.add("start", start);
        module.emit_wasm()
    }

    #[test]
    fn what_is_listed_and_what_only_that_calls_is_in_the_rest_behind_a_gate() {
        let split = split(&module(), &|name| name.starts_with("later::")).unwrap();
        let (first, rest) = (read(&split.first).unwrap(), read(&split.rest).unwrap());
        // start and helper, and the gate of begin
        assert_eq!(first.funcs.iter_local().count(), 3);
        let exports: Vec<&str> = first.exports.iter().map(|e| e.name.as_str()).collect();
        let [.., shared] = exports[..] else { panic!("nothing is exported") };
        assert_eq!(exports, ["start", TABLE, THERE, shared]);
        // begin and twice, which are given helper and the table that begin goes into
        assert_eq!(rest.funcs.iter_local().count(), 2);
        let imports: Vec<(&str, &str)> =
            rest.imports.iter().map(|i| (i.module.as_str(), i.name.as_str())).collect();
        assert_eq!(imports, [(FIRST, TABLE), (FIRST, shared)]);
        assert_eq!(rest.elements.iter().count(), 1);
    }

    #[test]
    fn a_module_that_cannot_have_its_rest_fetched_is_refused() {
        let empty = Module::with_config(ModuleConfig::new()).emit_wasm();
        assert!(split(&empty, &|_| false).is_err());
    }
}
