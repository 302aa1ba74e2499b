# How long it took, what was made from what, and what came out.


rule tabulate_timings:
    input:
        results=STUDY_RESULTS,
    output:
        "results/tables/timings.csv",
    log:
        "results/logs/tabulate_timings.log",
    benchmark:
        "results/benchmarks/tabulate_timings.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code_of("tabulate_timings"),
        benchmarks=benchmarks(),
    message:
        "sum the benchmark files by stage"
    shell:
        "sedfiber tabulate_timings {params.benchmarks} -o {output} > {log} 2>&1"


rule write_manifest:
    input:
        results=STUDY_RESULTS,
        timings=rules.tabulate_timings.output,
        lock=here(BASE / "envs/requirements.lock"),
    output:
        "results/manifest.json",
    log:
        "results/logs/write_manifest.log",
    benchmark:
        "results/benchmarks/write_manifest.tsv"
    conda:
        "../../envs/analysis.yaml"
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code_of("write_manifest"),
        config=as_json(config),
        commit=commit(),
        snakefile=here(BASE / "Snakefile"),
        configfiles=[str(path) for path in workflow.configfiles],
    message:
        "record where every result comes from"
    shell:
        "snakemake --snakefile {params.snakefile} --configfile {params.configfiles}"
        " --rulegraph dot 2> {log} | "
        "sedfiber write_manifest --config {params.config:q} --commit {params.commit} --lock {input.lock}"
        " --rule-graph - --outputs {input.results} {input.timings} -o {output} >> {log} 2>&1"
