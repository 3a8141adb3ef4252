//! A module in two parts: the functions that a first drag runs, and the rest, which may come after it.
//!
//! The first part has everything but the bodies of the rest's functions, and the data of which these alone speak
//! ([`crate::data`]). In their place stand stubs, which have the second part loaded when it is not there yet and call
//! through the table. The second part imports the first one's memory, tables, globals and functions; when it is
//! instantiated it puts its own functions into the table and its data into the memory. Which functions are of the rest
//! decides only what is sent when: any division is correct. `crates/web/rest.txt` lists them by [`keys_of`], as an
//! instrumented page ([`follow`]) was seen not to call them; what is not listed is of the first part.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use walrus::ir::Value;
use walrus::{
    ConstExpr, DataKind, ElementItems, ElementKind, Export, ExportItem, FunctionBuilder,
    FunctionId, FunctionKind, GlobalId, GlobalKind, ImportKind, ImportedFunction, LocalId, Module,
    ModuleConfig, TableId,
};

use crate::data;

/// The name of the first part among the imports of the second.
const FIRST: &str = "first";
/// What the page imports to have the second part loaded at once (`crates/web/assets/rest.js`).
const LOAD: &str = "loadRest";

/// The two parts, as WebAssembly.
pub(crate) struct Parts {
    pub(crate) first: Vec<u8>,
    pub(crate) rest: Vec<u8>,
}

/// What FNV-1a begins with, at 32 bits.
const BASIS: u32 = 0x811c_9dc5;

/// The keys of a module's functions, in order: the 32-bit FNV-1a hash of a name as people read it, without the
/// compiler's hashes of crates (`core[1f…]`), which differ from build to build; where a name comes again, which one it
/// is stands behind it.
fn keys_of(module: &Module) -> Vec<u32> {
    let mut seen: BTreeMap<u32, u32> = BTreeMap::new();
    let mut key = |function: &walrus::Function| {
        let name = rustc_demangle::demangle(function.name.as_deref().unwrap_or_default());
        let name = hash_of(&name.to_string());
        let before = seen.entry(name).or_default();
        *before += 1;
        if *before == 1 { name } else { before.to_le_bytes().into_iter().fold(name, hashed) }
    };
    module.funcs.iter().map(&mut key).collect()
}

fn hash_of(name: &str) -> u32 {
    let mut hash = BASIS;
    let mut rest = name;
    while !rest.is_empty() {
        let (text, after) = rest.split_once('[').unwrap_or((rest, ""));
        let is_hash = |inner: &str| inner.len() > 8 && inner.bytes().all(|b| b.is_ascii_hexdigit());
        rest = after
            .split_once(']')
            .filter(|(inner, _)| is_hash(inner))
            .map_or(after, |(_, next)| next);
        hash = text.bytes().fold(hash, hashed);
    }
    hash
}

fn hashed(hash: u32, byte: u8) -> u32 {
    (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193)
}

/// The keys that a list names, which has them in hexadecimal between spaces, and remarks after `#`.
pub(crate) fn keys(list: &str) -> BTreeSet<u32> {
    let lines = list.lines().filter(|line| !line.starts_with('#'));
    lines
        .flat_map(str::split_whitespace)
        .filter_map(|key| u32::from_str_radix(key, 16).ok())
        .collect()
}

fn read(bytes: &[u8], is_named: bool) -> Result<Module, String> {
    let mut config = ModuleConfig::new();
    config.generate_name_section(is_named).generate_producers_section(false);
    let mut module = config.parse(bytes).map_err(|error| format!("{error:#}"))?;
    for left_by_linker in ["linking", "reloc.CODE", "reloc.DATA"] {
        module.customs.remove_raw(left_by_linker);
    }
    Ok(module)
}

/// Divides a module whose functions have the linker's names; they keep them, as people read them, where `is_named`.
/// From the module as it was `linked` it is told which data come with the rest.
///
/// # Errors
/// A module that is none, or that does not import what loads its second part.
pub(crate) fn split(
    bytes: &[u8],
    linked: &[u8],
    rest: &BTreeSet<u32>,
    is_named: bool,
) -> Result<Parts, String> {
    let mut one = read(bytes, is_named)?;
    let mut two = read(bytes, is_named)?;
    let is_of_rest = |(function, key): (&walrus::Function, u32)| {
        matches!(function.kind, FunctionKind::Local(_)) && rest.contains(&key)
    };
    let rest: Vec<bool> = one.funcs.iter().zip(keys_of(&one)).map(is_of_rest).collect();
    let names = one.funcs.iter().zip(&rest).filter(|&(_, &is_of_rest)| is_of_rest);
    let names: BTreeSet<&str> = names.filter_map(|(f, _)| f.name.as_deref()).collect();
    let late = data::late(linked, &names)?;
    for function in one.funcs.iter_mut().chain(two.funcs.iter_mut()) {
        let name = function.name.as_deref().map(rustc_demangle::demangle);
        function.name = name.map(|name| name.to_string());
    }
    let table = function_table(&one)?;
    let slots = one.tables.get(table).initial;
    let count = rest.iter().filter(|&&is_of_rest| is_of_rest).count() as u64;
    for module in [&mut one, &mut two] {
        let table = function_table(module)?;
        let table = module.tables.get_mut(table);
        table.initial += count;
        table.maximum = table.maximum.map(|most| most + count);
    }
    let zero = ConstExpr::Value(Value::I32(0));
    let is_loaded = one.globals.add_local(walrus::ValType::I32, true, false, zero);
    let build = format!("of_{:08x}", bytes.iter().fold(BASIS, |hash, &byte| hashed(hash, byte)));
    stand_in(&mut one, &rest, slots, is_loaded)?;
    let data = take(&mut one, &late);
    detach(&mut two, &rest, slots)?;
    give(&mut two, data)?;
    share(&mut one, &mut two, is_loaded, &build)?;
    Ok(Parts { first: one.emit_wasm(), rest: two.emit_wasm() })
}

fn function_table(module: &Module) -> Result<TableId, String> {
    let table = module.tables.main_function_table().map_err(|error| error.to_string())?;
    table.ok_or_else(|| String::from("the module has no table of functions"))
}

/// Puts stubs in the place of the rest's functions.
fn stand_in(
    module: &mut Module,
    rest: &[bool],
    slots: u64,
    is_loaded: GlobalId,
) -> Result<(), String> {
    let load = module.imports.iter().find_map(|import| match import.kind {
        ImportKind::Function(load) if import.name == LOAD => Some(load),
        _ => None,
    });
    let load = load.ok_or_else(|| String::from("the page does not import loadRest"))?;
    let table = function_table(module)?;
    let ensure = {
        let mut builder = FunctionBuilder::new(&mut module.types, &[], &[]);
        builder.func_body().global_get(is_loaded).if_else(
            None,
            |_| {},
            |otherwise| {
                otherwise.call(load);
            },
        );
        builder.finish(Vec::new(), &mut module.funcs)
    };
    let ids: Vec<FunctionId> = module.funcs.iter().map(walrus::Function::id).collect();
    let rest = ids.into_iter().zip(rest).filter(|&(_, &is_of_rest)| is_of_rest);
    for ((id, _), slot) in rest.zip(slots..) {
        let kind = module.funcs.get(id).ty();
        let (params, results) = module.types.params_results(kind);
        let (params, results) = (params.to_vec(), results.to_vec());
        let arguments: Vec<LocalId> = params.iter().map(|&kind| module.locals.add(kind)).collect();
        let mut stub = FunctionBuilder::new(&mut module.types, &params, &results);
        let mut body = stub.func_body();
        body.call(ensure);
        for &argument in &arguments {
            body.local_get(argument);
        }
        body.const_(Value::I32(slot as i32)).call_indirect(kind, table);
        module.funcs.get_mut(id).kind = FunctionKind::Local(stub.local_func(arguments));
    }
    Ok(())
}

/// Takes ranges out of a module's data; gives what stood there, each with its address.
fn take(module: &mut Module, ranges: &[Range<u32>]) -> Vec<(u32, Vec<u8>)> {
    let mut taken = Vec::new();
    for data in module.data.iter().map(walrus::Data::id).collect::<Vec<_>>() {
        let data = module.data.get_mut(data);
        let DataKind::Active { offset: ConstExpr::Value(Value::I32(begin)), .. } = data.kind else {
            continue;
        };
        let begin = begin.cast_unsigned();
        for range in ranges {
            let place = |address: u32| address.checked_sub(begin).map(|place| place as usize);
            let (Some(from), Some(to)) = (place(range.start), place(range.end)) else { continue };
            // nothing compresses better than zeros
            if let Some(bytes) = data.value.get_mut(from..to) {
                taken.push((range.start, bytes.to_vec()));
                bytes.fill(0);
            }
        }
    }
    taken
}

/// Gives a module data, each at its address.
fn give(module: &mut Module, data: Vec<(u32, Vec<u8>)>) -> Result<(), String> {
    let memory = module.get_memory_id().map_err(|error| error.to_string())?;
    for (address, bytes) in data {
        let offset = ConstExpr::Value(Value::I32(address.cast_signed()));
        let data = module.data.add(DataKind::Active { memory, offset }, bytes);
        module.memories.get_mut(memory).data_segments.insert(data);
    }
    Ok(())
}

/// Leaves of a module the rest's functions, in their slots of the table; all else is imported.
fn detach(module: &mut Module, rest: &[bool], slots: u64) -> Result<(), String> {
    module.start = None;
    for export in module.exports.iter().map(Export::id).collect::<Vec<_>>() {
        module.exports.delete(export);
    }
    for data in module.data.iter().map(walrus::Data::id).collect::<Vec<_>>() {
        module.data.delete(data);
    }
    for element in module.elements.iter().map(walrus::Element::id).collect::<Vec<_>>() {
        module.elements.delete(element);
    }
    let table = function_table(module)?;
    let imports = &mut module.imports;
    for memory in module.memories.iter_mut() {
        memory.data_segments.clear();
        memory.import = Some(imports.add(FIRST, "m", memory.id()));
    }
    for (i, table) in module.tables.iter_mut().enumerate() {
        table.elem_segments.clear();
        table.import = Some(imports.add(FIRST, &format!("t{i}"), table.id()));
    }
    for (i, id) in
        module.globals.iter().map(walrus::Global::id).collect::<Vec<_>>().into_iter().enumerate()
    {
        module.globals.get_mut(id).kind =
            GlobalKind::Import(imports.add(FIRST, &format!("g{i}"), id));
    }
    let mut own = Vec::new();
    for ((i, function), is_of_rest) in module.funcs.iter_mut().enumerate().zip(rest) {
        match (&mut function.kind, is_of_rest) {
            (_, true) => own.push(function.id()),
            (FunctionKind::Import(imported), _) => {
                let import = imports.get_mut(imported.import);
                import.module = String::from(FIRST);
                import.name = format!("f{i}");
            }
            (_, false) => {
                let import = imports.add(FIRST, &format!("f{i}"), function.id());
                let ty = function.ty();
                function.kind = FunctionKind::Import(ImportedFunction { import, ty });
            }
        }
    }
    let offset = ConstExpr::Value(Value::I32(slots as i32));
    let element =
        module.elements.add(ElementKind::Active { table, offset }, ElementItems::Functions(own));
    module.tables.get_mut(table).elem_segments.insert(element);
    walrus::passes::gc::run(module);
    Ok(())
}

/// Has the first part export what the second one imports; the second one says in `is_loaded` that it is there. This has
/// a name of the `build`: parts of two builds do not fit.
fn share(
    one: &mut Module,
    two: &mut Module,
    is_loaded: GlobalId,
    build: &str,
) -> Result<(), String> {
    let functions: Vec<FunctionId> = one.funcs.iter().map(walrus::Function::id).collect();
    let tables: Vec<TableId> = one.tables.iter().map(walrus::Table::id).collect();
    let globals: Vec<GlobalId> = one.globals.iter().map(walrus::Global::id).collect();
    let memory = one.get_memory_id().map_err(|error| error.to_string())?;
    for import in two.imports.iter() {
        let place = import.name.get(1..).and_then(|number| number.parse::<usize>().ok());
        let item = match import.kind {
            ImportKind::Memory(_) => ExportItem::Memory(memory),
            ImportKind::Table(_) => ExportItem::Table(tables[place.unwrap_or_default()]),
            ImportKind::Global(_) => ExportItem::Global(globals[place.unwrap_or_default()]),
            ImportKind::Function(_) => ExportItem::Function(functions[place.unwrap_or_default()]),
            ImportKind::Tag(_) => {
                return Err(String::from("a module with exceptions is not divided"));
            }
        };
        one.exports.add(&import.name, item);
    }
    one.exports.add(build, is_loaded);
    // by this the page knows that there is a rest
    one.exports.add("is_divided", is_loaded);
    let (loaded, _) = two.add_import_global(FIRST, build, walrus::ValType::I32, true, false);
    let mut begin = FunctionBuilder::new(&mut two.types, &[], &[]);
    begin.func_body().i32_const(1).global_set(loaded);
    two.start = Some(begin.finish(Vec::new(), &mut two.funcs));
    walrus::passes::gc::run(one);
    Ok(())
}

/// Where an instrumented module marks what has been called: a byte a function, from this address on, which is the end
/// of the memory that the module asked for.
pub(crate) struct Followed {
    pub(crate) module: Vec<u8>,
    /// The functions' keys, in the order of their bytes.
    pub(crate) keys: Vec<u32>,
    pub(crate) address: u64,
}

/// Has every function mark that it has been called.
pub(crate) fn follow(bytes: &[u8]) -> Result<Followed, String> {
    const PAGE: u64 = 1 << 16;
    let mut module = read(bytes, true)?;
    let memory = module.get_memory_id().map_err(|error| error.to_string())?;
    let address = module.memories.get(memory).initial * PAGE;
    let mut keys = Vec::new();
    for (key, function) in keys_of(&module).into_iter().zip(module.funcs.iter_mut()) {
        let FunctionKind::Local(body) = &mut function.kind else { continue };
        let place = address + keys.len() as u64;
        keys.push(key);
        let mark = walrus::ir::MemArg { align: 1, offset: place };
        body.builder_mut()
            .func_body()
            .instr_at(
                0,
                walrus::ir::Store {
                    memory,
                    kind: walrus::ir::StoreKind::I32_8 { atomic: false },
                    arg: mark,
                },
            )
            .instr_at(0, walrus::ir::Const { value: Value::I32(1) })
            .instr_at(0, walrus::ir::Const { value: Value::I32(0) });
    }
    module.memories.get_mut(memory).initial += (keys.len() as u64).div_ceil(PAGE);
    Ok(Followed { module: module.emit_wasm(), keys, address })
}
